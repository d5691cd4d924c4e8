#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// Sufficient statistics of the answers at one point for a model with independent noise. Welford's update avoids
/// cancellation.
struct Replicates {
  double weight = 0;   ///< sum of the answers' weights; their number for weights of 1
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

/// Points with repetitions.
struct Sites {
  std::vector<UnitPoint> points;  ///< distinct ones, in the order of their first appearance
  std::vector<std::size_t> of;    ///< index into `points` for each given point
};
Sites sites_of(std::span<const UnitPoint> points);

/// Variance between the packings of a point. At the transition from heaps that keep their shape to heaps that shear
/// off, one material does both, depending on the packing: its mean reading may equal the measurement although no heap
/// does. Method: kernel regression over the unit cube of the squared deviations of simulations from the mean expected
/// at their point; the harmless variance enters everywhere as a few further simulations.
class ReplicateVariance {
 public:
  /// `harmless`: variance of one simulation below which scatter does not matter, > 0. Shapes: n points of the unit
  /// cube, n deviations.
  ReplicateVariance(std::vector<UnitPoint> points, const Eigen::VectorXd& deviations, double harmless);

  /// Variance between the packings of a point above the harmless one, >= 0.
  double excess(const UnitPoint& point) const;

  /// Harmless variance over the variance at a point, <= 1: precision of a simulation there, for a Gaussian process.
  double precision(const UnitPoint& point) const { return harmless_ / (harmless_ + excess(point)); }

 private:
  std::vector<UnitPoint> points_;
  std::vector<double> squares_;
  double harmless_;
};

}  // namespace pastefit
