#pragma once

#include <cmath>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// The Matérn 5/2 covariance of two points, with one length for each coordinate; with variance 1 their correlation:
///     variance (1 + r + r^2/3) exp(-r),   r = sqrt(5) |(a - b)/lengths|.
/// Source: Rasmussen & Williams, Gaussian Processes for Machine Learning (2006), equation 4.17.
inline double matern_covariance(const UnitPoint& a, const UnitPoint& b, const Eigen::VectorXd& lengths,
                                double variance = 1) {
  const double r = std::sqrt(5.0) * ((a - b).array() / lengths.array()).matrix().norm();
  return variance * (1 + r + r * r / 3) * std::exp(-r);
}

}  // namespace pastefit
