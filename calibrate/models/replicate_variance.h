#pragma once

#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// How much the packings of a point disagree. Between materials whose heaps stand and materials whose heaps shear off
/// there are some whose heaps do either, depending on the packing: their mean reading may equal the laboratory's though
/// no single heap does. A deviation is the difference between a simulation and the mean expected at its point. Method:
/// kernel regression of squared deviations over the unit cube; at every point the harmless variance counts as a few
/// further simulations.
class ReplicateVariance {
 public:
  /// `harmless`: variance of one simulation up to which its scatter does not matter, > 0. Shapes: n points of the unit
  /// cube, n deviations.
  ReplicateVariance(std::vector<UnitPoint> points, const Eigen::VectorXd& deviations, double harmless);

  /// Variance between the packings of a point in excess of the harmless one, >= 0.
  double excess(const UnitPoint& point) const;

  /// Harmless variance over the variance at a point, <= 1: the precision of a simulation there, for a Gaussian process.
  double precision(const UnitPoint& point) const { return harmless_ / (harmless_ + excess(point)); }

 private:
  std::vector<UnitPoint> points_;
  std::vector<double> squares_;
  double harmless_;
};

}  // namespace pastefit
