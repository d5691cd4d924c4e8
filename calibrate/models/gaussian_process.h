#pragma once

#include <span>
#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// A Gaussian process with constant mean, Matérn 5/2 covariance with one length for each coordinate, and noise. Mean
/// and variance are profiled out; lengths and noise maximise the likelihood times a broad prior that favours smooth
/// answers, so that it does not follow the noise of a few dozen answers. Answers of one point are pooled, which changes
/// nothing but the time it takes. Source: Rasmussen & Williams, Gaussian Processes for Machine Learning (2006),
/// sections 2.2, 4.2.1, 5.4.1.
class GaussianProcess {
 public:
  struct Prediction {
    double mean = 0;
    double variance = 0;  ///< of the mean answer, without the noise of one simulation
  };

  /// Shapes: n >= 1 points of the unit cube, n values, n precisions > 0 (none: all 1): the noise variance of an answer
  /// is that of the process over its precision. Points may repeat: that is how the noise is seen.
  GaussianProcess(std::span<const UnitPoint> points, const Eigen::VectorXd& values,
                  const Eigen::VectorXd& precisions = {});

  /// Conditions on a point that has not been answered, as if the mean of so many answers were known (fantasising);
  /// lengths and noise ratio stay.
  void fantasise(const UnitPoint& point, double mean, int answers);

  Prediction predict(const UnitPoint& point) const;
  /// Logarithm of the likelihood of the answers, but for a constant of their number; infinite if all are the same.
  double log_likelihood() const;
  const Eigen::VectorXd& lengths() const { return lengths_; }
  double signal_variance() const { return signal_variance_; }
  /// Of an answer of precision 1.
  double noise_variance() const { return signal_variance_ * noise_ratio_; }

 private:
  /// The negative logarithm of likelihood and prior as a positive number: to the power 2/n.
  double deviance() const;
  void pool(std::span<const UnitPoint> points, const Eigen::VectorXd& values, const Eigen::VectorXd& precisions);
  void set(const Eigen::VectorXd& lengths, double noise_ratio);

  std::vector<UnitPoint> points_;  // distinct
  Eigen::VectorXd values_;         // mean answer of each
  Eigen::VectorXd counts_;         // answers of each, or rather the sum of their precisions
  double answers_ = 0;             // in all
  double squares_within_ = 0;      // of the answers about the mean of their point, times their precisions
  Eigen::VectorXd lengths_;
  double noise_ratio_ = 0;      // noise variance over signal variance
  double signal_variance_ = 0;  // 0: all values are the same
  double mean_ = 0;
  double log_determinant_ = 0;
  Eigen::MatrixXd factor_;   // lower Cholesky factor of the correlation matrix with noise
  Eigen::VectorXd weights_;  // inverse correlation matrix times (values - mean)
};

}  // namespace pastefit
