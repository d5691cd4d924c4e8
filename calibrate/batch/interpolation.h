#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/batch/batch.h"

namespace pastefit {

/// How a number is taken to depend on a variable.
enum class TrendModel { linear, gaussian_process };

/// The model as it is stored and printed, e.g. "gaussian_process".
std::string_view name_of(TrendModel model);

/// A number predicted at one value of the variable.
struct TrendPrediction {
  double mean = 0;
  double half_width = 0;  ///< of the 95 % interval for one more material there, its scatter about the trend included
};

/// Fits the numbers `y` seen at `x` and predicts at `at`. Linear: least squares, with Student's prediction interval
///     t(0.975; n - 2) s sqrt(1 + 1/n + (at - mean x)^2/sum (x - mean x)^2),   s^2 = sum of squares/(n - 2).
/// Gaussian process: `GaussianProcess` over the range of x, with 1.96 deviations of its mean and its noise together.
/// Requirements: as many y as x, three at least, and not all x the same.
TrendPrediction predict_trend(std::span<const double> x, std::span<const double> y, double at, TrendModel model);

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
