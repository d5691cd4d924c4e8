#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

/// The range of a positive hyper-parameter, mapped to [0, 1] on a logarithmic scale.
struct LogRange {
  double low = 0.1, high = 1;

  double at(double share) const;
  /// Clamped to [0, 1].
  double share_of(double value) const;
};

/// Correlation lengths, in edge lengths of the unit cube.
inline constexpr LogRange length_range{0.15, 15};

/// Hyper-parameters of least deviance, by Subplex from `start`. `deviance`: a positive function on the unit cube, e.g.
/// a likelihood to the power -2/n. `evaluations_each`: evaluations allowed for each hyper-parameter.
UnitPoint fit_hyperparameters(const std::function<double(const UnitPoint&)>& deviance, const UnitPoint& start,
                              int evaluations_each);

/// The Matérn 5/2 covariance of two points, with one length for each coordinate; with variance 1 their correlation:
///     variance (1 + r + r^2/3) exp(-r),   r = sqrt(5) |(a - b)/lengths|.
/// Source: Rasmussen & Williams, Gaussian Processes for Machine Learning (2006), equation 4.17.
inline double matern_covariance(const UnitPoint& a, const UnitPoint& b, const Eigen::VectorXd& lengths,
                                double variance = 1) {
  const double r = std::sqrt(5.0) * ((a - b).array() / lengths.array()).matrix().norm();
  return variance * (1 + r + r * r / 3) * std::exp(-r);
}

/// Gaussian process with constant mean, Matérn 5/2 covariance with one length for each coordinate, and noise. Mean and
/// signal variance are profiled out; lengths and the ratio of noise to signal maximise the likelihood times a broad
/// prior that favours smooth functions, so that the process does not follow the noise of a few dozen answers. Answers
/// at one point are pooled, which is exact and faster. Source: Rasmussen & Williams, Gaussian Processes for Machine
/// Learning (2006), sections 2.2, 4.2.1, 5.4.1.
class GaussianProcess {
 public:
  struct Prediction {
    double mean = 0;
    double variance = 0;  ///< of the mean, without the noise of one simulation
  };

  /// Shapes: n >= 1 points of the unit cube, n values, n precisions > 0 (empty: all 1). The noise variance of an answer
  /// is `noise_variance()` over its precision. Repeated points separate noise from signal.
  GaussianProcess(std::span<const UnitPoint> points, const Eigen::VectorXd& values,
                  const Eigen::VectorXd& precisions = {});

  /// Conditions on a fantasised mean of `answers` answers at a new point; lengths and noise ratio are kept.
  void fantasise(const UnitPoint& point, double mean, int answers);

  Prediction predict(const UnitPoint& point) const;
  /// Log-likelihood of the answers, up to a constant that depends on their number only; infinite if all are equal.
  double log_likelihood() const;
  const Eigen::VectorXd& lengths() const { return lengths_; }
  double signal_variance() const { return signal_variance_; }
  /// Noise variance of an answer of precision 1.
  double noise_variance() const { return signal_variance_ * noise_ratio_; }

 private:
  /// (likelihood times prior)^(-2/n), n answers; positive, to be minimised.
  double deviance() const;
  void pool(std::span<const UnitPoint> points, const Eigen::VectorXd& values, const Eigen::VectorXd& precisions);
  void set(const Eigen::VectorXd& lengths, double noise_ratio);

  std::vector<UnitPoint> points_;  // distinct
  Eigen::VectorXd values_;         // mean answer of each
  Eigen::VectorXd counts_;         // sum of the precisions of its answers
  double answers_ = 0;             // number of answers
  double squares_within_ = 0;  // squared deviations of the answers from the mean of their point, times their precisions
  Eigen::VectorXd lengths_;
  double noise_ratio_ = 0;      // noise variance over signal variance
  double signal_variance_ = 0;  // 0: all values are equal
  double mean_ = 0;
  double log_determinant_ = 0;
  Eigen::MatrixXd factor_;   // lower Cholesky factor of the correlation matrix with noise
  Eigen::VectorXd weights_;  // inverse correlation matrix times (values - mean)
};

/// Probability that a scattered quantity exceeds its limit at a point, learnt from its values rather than from
/// exceedances: a value just below the limit shows that the next one may exceed it. Model: a Gaussian process of the
/// square root of value over limit, whose noise is the scatter. The length of a vector with two normal components (a
/// shift in any direction) has a nearly normal square root, so that the upper tail is accurate. Values far beyond the
/// limit are clipped, because their size carries little information.
class Exceedance {
 public:
  /// Transformed value over limit, nearly normal: square root, clipped to 1.5; 1 at the limit.
  static double root(double value) { return std::sqrt(std::clamp(value, 0.0, 2.25)); }

  /// Shapes: n >= 1 points of the unit cube, which may repeat; n values over their limit, >= 0.
  Exceedance(std::span<const UnitPoint> points, std::span<const double> values);

  /// Probability that the next value exceeds the limit.
  double probability(const UnitPoint& point) const;

  /// Probability that at most `exceeding` of `count` values exceed the limit: binomial distribution, averaged over the
  /// posterior of its probability.
  double probability_of_at_most(int exceeding, int count, const UnitPoint& point) const;

 private:
  GaussianProcess roots_;
};

}  // namespace pastefit
