#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "calibrate/models/gaussian_process.h"

namespace pastefit {

/// Probability that a scattered quantity exceeds its limit at a point, learnt from its values rather than from
/// exceedances: a value just below the limit shows that the next one may exceed it. Model: a Gaussian process of the
/// square root of value over limit, whose noise is the scatter. The length of a vector with two normal components (a
/// shift in any direction) has a nearly normal square root, so that the upper tail is accurate. Values far beyond the
/// limit are clipped, because their size carries little information.
class Exceedance {
 public:
  /// Transformed value over limit, nearly normal: square root, clipped to 1.5; 1 at the limit.
  static double root(double value) { return std::sqrt(std::clamp(value, 0.0, 2.25)); }

  /// Shapes: n >= 1 points of the unit cube, which may repeat; n values over their limit, >= 0.
  Exceedance(std::span<const UnitPoint> points, std::span<const double> values);

  /// Probability that the next value exceeds the limit.
  double probability(const UnitPoint& point) const;

  /// Probability that at most `exceeding` of `count` values exceed the limit: binomial distribution, averaged over the
  /// posterior of its probability.
  double probability_of_at_most(int exceeding, int count, const UnitPoint& point) const;

 private:
  GaussianProcess roots_;
};

}  // namespace pastefit
