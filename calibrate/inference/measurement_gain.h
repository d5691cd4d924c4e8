#pragma once

#include <string>
#include <vector>

#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

/// What further measurements would bring.
struct MeasurementGain {
  std::string reading;
  int measurements = 0;       ///< how many, by the same person
  double deviation = 0;       ///< of one of them, in the reading's unit
  std::string parameter;      ///< that gains most
  double narrowing = 1;       ///< its standard deviation after over before
  double lead_narrowing = 1;  ///< the same of the parameter that leads the best
                              ///< determined combination
};

/// What `repeats` further measurements would bring of each reading that a laboratory may be advised to take and that
/// the model meets, best first. `lead`: the parameter that leads the best determined combination.
std::vector<MeasurementGain> measurement_gains(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                               const Moments& moments, const UnitPoint& recommended, std::size_t lead,
                                               int repeats);

}  // namespace pastefit
