#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "calibrate/models/gaussian_process.h"

namespace pastefit {

/// How likely a quantity that scatters is to exceed its limit at a point, learnt from its values and not from yes and
/// no: one that comes near its limit tells that the next may exceed it. A Gaussian process of the square root of value
/// over limit, whose noise is the scatter: the length of a vector with two normal components (a shift to any side)
/// becomes nearly normal by its root, and its upper tail true. Values far beyond the limit are learnt as less: once the
/// limit is exceeded, by how much says little.
class Exceedance {
 public:
  /// Of a value over its limit: what is learnt, nearly normal; 1 at the limit, no more than 1.5.
  static double root(double value) { return std::sqrt(std::clamp(value, 0.0, 2.25)); }

  /// Shapes: n >= 1 points of the unit cube, which may repeat, n values over their limit, >= 0.
  Exceedance(std::span<const UnitPoint> points, std::span<const double> values);

  /// That the next value exceeds the limit.
  double probability(const UnitPoint& point) const;

  /// That of `count` values at most `exceeding` exceed the limit: the binomial distribution, averaged over what is not
  /// known of their common probability.
  double probability_of_at_most(int exceeding, int count, const UnitPoint& point) const;

 private:
  GaussianProcess roots_;
};

}  // namespace pastefit
