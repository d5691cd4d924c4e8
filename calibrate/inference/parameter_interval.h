#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

/// Interval estimate of one free parameter, in its own unit.
struct ParameterInterval {
  std::string name;
  Scale scale = Scale::linear;
  double bound_lower = 0, bound_upper = 0;  ///< of the study
  double recommended = 0;
  double lower = 0, upper = 0;  ///< 95 % credible interval, all parameters free; an end that the data do not set is
                                ///< the study's bound
  bool lower_known = false, upper_known = false;  ///< the end is set by the data, not by the study's bound
  double held_lower = 0, held_upper = 0;          ///< 95 %, the other parameters held at the recommended values
  std::optional<Prior> prior;                     ///< of the study; contained in all of these
  double deviation_before = 0;                    ///< prior standard deviation of the coordinate, bounds included
  double uncertainty = 1;                         ///< posterior standard deviation over the prior one

  bool interval_exists() const { return lower_known && upper_known; }
  bool not_identified() const { return !lower_known && !upper_known; }
};

/// Prior standard deviation of a coordinate: uniform between the bounds, or of the prior truncated to them.
double deviation_before(const Parameter& parameter);
/// Of each.
Eigen::VectorXd deviations_before(const TrainingData& evidence);

/// The interval of the parameter at a coordinate. `sample`: of the posterior; `moments`: of that sample.
ParameterInterval interval_of(const ResponseModel& model, const std::vector<UnitPoint>& sample, const Moments& moments,
                              const UnitPoint& recommended, Eigen::Index coordinate);

}  // namespace pastefit
