#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "calibrate/models/gaussian_process.h"

namespace pastefit {

/// The probability that a quantity with scatter exceeds its limit at a point, learnt from its values rather than from
/// whether they exceeded it: a value just below the limit shows that the next one may exceed it. A Gaussian process of
/// the square root of value over limit; its noise is the scatter. The length of a vector with two normal components (a
/// shift to any side) has a nearly normal square root, so that the upper tail is right. Values far beyond the limit are
/// clipped: once the limit is exceeded, the amount says little.
class Exceedance {
 public:
  /// The quantity that is learnt, nearly normal, of a value over its limit: its square root, clipped to 1.5; 1 at the
  /// limit.
  static double root(double value) { return std::sqrt(std::clamp(value, 0.0, 2.25)); }

  /// Shapes: n >= 1 points of the unit cube, which may repeat; n values over their limit, >= 0.
  Exceedance(std::span<const UnitPoint> points, std::span<const double> values);

  /// Probability that the next value exceeds the limit.
  double probability(const UnitPoint& point) const;

  /// Probability that at most `exceeding` of `count` values exceed the limit: the binomial distribution, averaged over
  /// the posterior of their common probability.
  double probability_of_at_most(int exceeding, int count, const UnitPoint& point) const;

 private:
  GaussianProcess roots_;
};

}  // namespace pastefit
