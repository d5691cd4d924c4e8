#pragma once

#include <string>
#include <vector>

#include "calibrate/batch/batch.h"
#include "calibrate/batch/trend.h"

namespace pastefit {

/// A mix between calibrated ones.
struct MixInBetween {
  std::string variable;  ///< as in the table of the batch, e.g. "mix.water_kg_m3"
  double value = 0;
  TrendModel model = TrendModel::linear;
};

/// The card of a mix in between: each fitted parameter (its logarithm, where it was searched on a logarithmic scale)
/// and the bulk density, predicted from the confirmed cards of the batch, within the bounds of the study; apparatus and
/// grains are those of the nearest of these mixes. Nothing is simulated: the card has no readings, and says that it is
/// interpolated and not confirmed. Its intervals are those of the prediction (`predict_trend`), which do not contain
/// what the readings of a single mix leave open.
/// Errors, of `batch` and the options --at and --from: a variable that no laboratory file has, fewer than three
/// confirmed cards with it, a value that does not lie between theirs, studies with other contact laws, parameters or
/// bounds.
Result<Card> interpolated_card(const std::vector<BatchStudy>& batch, const MixInBetween& mix);

}  // namespace pastefit
