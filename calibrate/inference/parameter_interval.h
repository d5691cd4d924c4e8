#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/inference/posterior.h"
#include "calibrate/inference/response_model.h"

namespace pastefit {

struct IntervalEnd {
  double at = 0;
  bool known = false;  ///< the data set this end, not the study's bound
};

/// Interval estimate of one free parameter, in its own unit.
struct ParameterInterval {
  Parameter parameter;  ///< its bounds and prior are included in all of these
  double recommended = 0;
  IntervalEnd lower, upper;                     ///< 95 %, all parameters free; the study's bound if the data set none
  IntervalEnd held_lower, held_upper;           ///< 95 %, others held at the recommended values; within the above
  double fitting_lower = 0, fitting_upper = 0;  ///< of materials expected to fit, others free
  double deviation_before = 0;                  ///< prior standard deviation of its coordinate, from bounds and prior
  double uncertainty = 1;                       ///< posterior over prior standard deviation

  bool interval_exists() const { return lower.known && upper.known; }
  bool held_exists() const { return held_lower.known || held_upper.known; }
  /// True if materials expected to fit lie near both bounds.
  bool any_value_fits() const;
  bool not_identified() const { return !lower.known && !upper.known; }
};

/// Prior standard deviation of a coordinate: uniform between the bounds, or of the prior truncated to them.
double deviation_before(const Parameter& parameter);
/// The same for each free parameter.
Eigen::VectorXd deviations_before(const TrainingData& evidence);

/// Sample of `count` coordinates from the posterior along one coordinate of `point`, the others held.
std::vector<double> sample_along(const ResponseModel& model, UnitPoint point, Eigen::Index coordinate, int count);

/// Interval of one parameter. `sample`: of the posterior; `moments`: of the sample. The interval with all parameters
/// free contains the one with the others held, and both contain the recommended value.
ParameterInterval interval_of(const ResponseModel& model, const std::vector<UnitPoint>& sample, const Moments& moments,
                              const UnitPoint& recommended, Eigen::Index coordinate);

/// Linear combination of the parameters near the recommended candidate: a right singular vector of the scaled Jacobian
/// of the readings.
struct Combination {
  Eigen::VectorXd direction;  ///< unit vector of changes of the free parameters over their `deviation_before`
  double singular_value = 0;  ///< of the Jacobian, readings and parameters in standard deviations
  double uncertainty = 1;  ///< posterior over prior deviation: 1/sqrt(1 + singular_value^2), or the sample's if larger
  std::size_t lead = 0;    ///< parameter with the largest component, which is positive
  double lead_width = 0;   ///< 95 % half width as change of the lead alone: relative if logarithmic, else in its unit
  std::vector<std::string> readings;  ///< those that depend on it, the strongest first

  bool determined() const { return uncertainty <= 0.5; }
};

/// Combinations from the slopes of the fitted readings at a candidate; best determined first, one for each free
/// parameter.
std::vector<Combination> combinations_of(const ResponseModel& model, const UnitPoint& at);

/// Widens a combination to the sample's standard deviation along it, because slopes at one point underestimate it for a
/// curved posterior. The sample's replaces it if there is one parameter only.
void heed_sample(Combination& combination, const TrainingData& evidence, const Moments& moments);

}  // namespace pastefit
