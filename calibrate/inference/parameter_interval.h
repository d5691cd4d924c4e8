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
  double lower = 0, upper = 0;  ///< 95 %, all parameters free; the study's bound
                                ///< where the data set none
  bool lower_known = false,
       upper_known = false;  ///< the end was set by the data, not by the study's bound
  double held_lower = 0,
         held_upper = 0;  ///< 95 %, the other parameters held at the recommended values; within those above, and the
                          ///< same where no other is free
  bool held_lower_known = false, held_upper_known = false;  ///< as above
  double fitting_lower = 0, fitting_upper = 0;  ///< of materials that are expected to fit, wherever the others are
  std::optional<Prior> prior;                   ///< what was known beforehand, contained in all of these
  double deviation_before = 0;                  ///< of its coordinate, by the bounds and the prior alone
  double uncertainty = 1;                       ///< standard deviation after the measurement over that one

  bool interval_exists() const { return lower_known && upper_known; }
  bool held_exists() const { return held_lower_known || held_upper_known; }
  /// Materials that are expected to fit lie near both bounds.
  bool any_value_fits() const;
  bool not_identified() const { return !lower_known && !upper_known; }
};

/// Prior standard deviation of a coordinate: uniform between the bounds, or of the prior truncated to them.
double deviation_before(const Parameter& parameter);
/// Of each.
Eigen::VectorXd deviations_before(const TrainingData& evidence);

/// The posterior along one coordinate of `point`, the others held, as `count` coordinates that lie in proportion to it.
std::vector<double> sample_along(const ResponseModel& model, UnitPoint point, Eigen::Index coordinate, int count);

/// Of the parameter of a coordinate. `sample`: of the posterior; `moments`: its own. The interval with all parameters
/// free contains the one with the others held, and both contain the recommended value.
ParameterInterval interval_of(const ResponseModel& model, const std::vector<UnitPoint>& sample, const Moments& moments,
                              const UnitPoint& recommended, Eigen::Index coordinate);

/// A linear combination of the parameters that the readings determine, near the recommended candidate: a right singular
/// vector of the scaled Jacobian of the readings.
struct Combination {
  std::vector<double> direction;      ///< unit vector; its components are changes of the free parameters over their
                                      ///< prior standard deviations (`deviation_before`)
  double singular_value = 0;          ///< of the Jacobian, readings and parameters in their standard deviations
  double uncertainty = 1;             ///< posterior over prior standard deviation along it: 1/sqrt(1 +
                                      ///< singular_value^2), or that of the sample if larger
  std::size_t lead = 0;               ///< the parameter with the largest component, which is positive
  double lead_width = 0;              ///< 95 % half width as a change of the lead alone: relative if its scale is
                                      ///< logarithmic, else in its unit
  std::vector<std::string> readings;  ///< that depend on it, the strongest first

  bool determined() const { return uncertainty <= 0.5; }
};

/// From the slopes of the fitted readings at a candidate; best determined first, one for each free parameter.
std::vector<Combination> combinations_of(const ResponseModel& model, const std::vector<std::size_t>& fitted,
                                         const UnitPoint& at);

/// Widens a combination to the standard deviation of the sample along it: slopes at one point promise too much where
/// the posterior is curved. The sample's alone counts where the combination is the only one.
void heed_sample(Combination& combination, const TrainingData& evidence, const Moments& moments);

}  // namespace pastefit
