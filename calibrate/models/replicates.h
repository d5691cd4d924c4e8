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

}  // namespace pastefit
