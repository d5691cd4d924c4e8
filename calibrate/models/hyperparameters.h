#pragma once

#include <functional>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// The range of a positive hyper-parameter, mapped to [0, 1] on a logarithmic scale.
struct LogRange {
  double low = 0.1, high = 1;

  double at(double share) const;
  /// Clamped to [0, 1].
  double share_of(double value) const;
};

/// Correlation lengths, in edge lengths of the unit cube.
inline constexpr LogRange length_range{0.15, 15};

/// The hyper-parameters of least deviance, by Subplex from `start`.
/// `deviance`: a positive function on the unit cube, for instance a likelihood to the power -2/n. `evaluations_each`:
/// evaluations allowed for each hyper-parameter.
UnitPoint fit_hyperparameters(const std::function<double(const UnitPoint&)>& deviance, const UnitPoint& start,
                              int evaluations_each);

}  // namespace pastefit
