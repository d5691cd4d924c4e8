#pragma once

#include <span>
#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// The probability that something happens at a point, learnt from places where it did and where it did not: a Gaussian
/// process through the logistic function, by Laplace's approximation, with a Matérn 5/2 covariance of one length for
/// all coordinates and a constant mean. Length and variance are those of most evidence on a coarse grid: a few dozen
/// yes and no tell no more of them.
/// Source: Rasmussen & Williams, Gaussian Processes for Machine Learning (2006), section 3.4, algorithms 3.1 and 3.2.
/// Cost: n^3/3 a Newton step, some hundred of them: 0.1 s for 150 points.
class Classifier {
 public:
  /// Shapes: n >= 1 points of the unit cube, which may repeat, and n labels.
  Classifier(std::span<const UnitPoint> points, const std::vector<bool>& labels);

  double probability(const UnitPoint& point) const;

 private:
  void fit(double length, double variance);

  std::vector<UnitPoint> points_;
  Eigen::VectorXd labels_;  // 0 or 1
  double mean_ = 0;         // of the latent function
  double length_ = 1, variance_ = 1;
  Eigen::VectorXd gradient_;  // of the logarithm of the likelihood at the mode
  Eigen::VectorXd root_;      // of minus its second derivative
  Eigen::MatrixXd factor_;    // lower Cholesky factor of 1 + root K root
  double log_evidence_ = 0;
};

}  // namespace pastefit
