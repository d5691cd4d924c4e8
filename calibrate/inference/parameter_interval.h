#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

/// What the data say about one free parameter, in its own unit.
struct ParameterInterval {
  std::string name;
  Scale scale = Scale::linear;
  double bound_lower = 0, bound_upper = 0;  ///< of the study
  double recommended = 0;
  double lower = 0, upper = 0;  ///< 95 %, all parameters free; the study's bound
                                ///< where the data set none
  bool lower_known = false,
       upper_known = false;  ///< the end was set by the data, not by the study's bound
  double held_lower = 0,
         held_upper = 0;        ///< 95 %, the other parameters held at the recommended values
  std::optional<Prior> prior;   ///< what was known beforehand, contained in all of these
  double deviation_before = 0;  ///< of its coordinate, by the bounds and the prior alone
  double uncertainty = 1;       ///< standard deviation after the measurement over that one

  bool interval_exists() const { return lower_known && upper_known; }
  bool not_identified() const { return !lower_known && !upper_known; }
};

/// Standard deviation of a coordinate before the test: evenly spread over the bounds, or of the prior between them.
double deviation_before(const Parameter& parameter);
/// Of each.
Eigen::VectorXd deviations_before(const TrainingData& evidence);

/// Of the parameter of a coordinate. `sample`: of the posterior; `moments`: its own.
ParameterInterval interval_of(const ResponseModel& model, const std::vector<UnitPoint>& sample, const Moments& moments,
                              const UnitPoint& recommended, Eigen::Index coordinate);

}  // namespace pastefit
