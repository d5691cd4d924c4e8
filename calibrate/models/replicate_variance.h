#pragma once

#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// Where the packings of a point disagree by more than a mean over some of them stands. Between heaps that stand and
/// heaps that shear off there are materials that do either, by the packing: their mean may be the
/// laboratory's, and no heap of theirs is. A *deviation* is what a simulation is off from what is expected at its
/// point. Formula: kernel regression of squared deviations over the unit cube, in which the harmless variance counts as
/// some simulations more, at every point.
class ReplicateVariance {
 public:
  /// `harmless`: variance of one simulation that is no matter, > 0. Shapes: n points of the unit cube, n deviations.
  ReplicateVariance(std::vector<UnitPoint> points, const Eigen::VectorXd& deviations, double harmless);

  /// Variance between the packings of a point beyond what is harmless, >= 0.
  double excess(const UnitPoint& point) const;

  /// The harmless variance over that at a point, <= 1.
  double precision(const UnitPoint& point) const { return harmless_ / (harmless_ + excess(point)); }

 private:
  std::vector<UnitPoint> points_;
  std::vector<double> squares_;
  double harmless_;
};

}  // namespace pastefit
