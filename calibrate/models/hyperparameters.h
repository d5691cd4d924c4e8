#pragma once

#include <functional>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// The range of a hyper-parameter, > 0, mapped to [0, 1] by its logarithm.
struct LogRange {
  double low = 0.1, high = 1;

  double at(double share) const;
  /// 0 and 1 of what lies outside.
  double share_of(double value) const;
};

/// Lengths of a correlation, in sides of the unit cube.
inline constexpr LogRange length_range{0.15, 15};

/// The hyper-parameters of least deviance, by Subplex from `start`.
/// `deviance`: of a point of the unit cube; > 0, for instance a likelihood to the power -2/n. `evaluations_each`: for
/// each hyper-parameter.
UnitPoint fit_hyperparameters(const std::function<double(const UnitPoint&)>& deviance, const UnitPoint& start,
                              int evaluations_each);

}  // namespace pastefit
