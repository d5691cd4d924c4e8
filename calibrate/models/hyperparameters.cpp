#include "calibrate/models/hyperparameters.h"

#include <algorithm>
#include <cmath>

#include "calibrate/optimisers/nlopt.h"

namespace pastefit {

double LogRange::at(double share) const {
  return low * std::pow(high / low, share);
}

double LogRange::share_of(double value) const {
  return std::clamp(std::log(value / low) / std::log(high / low), 0.0, 1.0);
}

UnitPoint fit_hyperparameters(const std::function<double(const UnitPoint&)>& deviance, const UnitPoint& start,
                              int evaluations_each) {
  const Problem problem = scalar_problem(static_cast<int>(start.size()), deviance);
  NloptOptions options;
  options.algorithm = "sbplx";
  options.evaluations = evaluations_each * problem.parameters;
  options.step_tolerance = 0.01;
  return minimise(problem, start, options).best.point;
}

}  // namespace pastefit
