#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// Answers at one point, pooled into what a model with independent noise needs of them. Welford's update, which does
/// not lose digits by cancellation.
struct Replicates {
  double weight = 0;   ///< sum of the answers' weights; their number, if each has a weight of 1
  double mean = 0;     ///< weighted
  double squares = 0;  ///< weighted sum of the squared differences between the answers and their mean

  /// Requirement: the weight is positive.
  void add(double answer, double its_weight = 1) {
    weight += its_weight;
    const double before = answer - mean;
    mean += its_weight / weight * before;
    squares += its_weight * before * (answer - mean);
  }
};

/// Points, of which some are equal.
struct Sites {
  std::vector<UnitPoint> points;  ///< the distinct ones, in the order of their first appearance
  std::vector<std::size_t> of;    ///< for each given point, its place in `points`
};
Sites sites_of(std::span<const UnitPoint> points);

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
