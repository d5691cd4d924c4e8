#pragma once

#include <string>
#include <vector>

#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

/// How much further measurements of one reading would narrow the posterior.
struct MeasurementGain {
  std::string reading;
  int measurements = 0;       ///< number of them
  double deviation = 0;       ///< of one of them, in the reading's unit
  std::string parameter;      ///< whose standard deviation shrinks most
  double narrowing = 1;       ///< its standard deviation afterwards over that before
  double lead_narrowing = 1;  ///< the same for the lead of the best determined combination
};

/// Gains of `repeats` further measurements, for each reading that a laboratory can take and that the model meets, best
/// first. `lead`: the parameter with the largest part in the best determined combination.
std::vector<MeasurementGain> measurement_gains(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                               const Moments& moments, const UnitPoint& recommended, std::size_t lead,
                                               int repeats);

}  // namespace pastefit
