#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// Answers of one point, pooled: what a model with independent noise needs of them. Welford's update, which does not
/// cancel.
struct Replicates {
  double weight = 0;   ///< sum of the answers' weights; their number, if each has a weight of 1
  double mean = 0;     ///< weighted
  double squares = 0;  ///< of the answers about their mean, weighted

  /// Requirement: the weight is positive.
  void add(double answer, double its_weight = 1) {
    weight += its_weight;
    const double before = answer - mean;
    mean += its_weight / weight * before;
    squares += its_weight * before * (answer - mean);
  }
};

/// Points of which some are the same.
struct Sites {
  std::vector<UnitPoint> points;  ///< each once, in the order in which they came
  std::vector<std::size_t> of;    ///< of each of the given points: which of them it is
};
Sites sites_of(std::span<const UnitPoint> points);

}  // namespace pastefit
