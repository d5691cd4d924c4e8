#pragma once

#include <memory>
#include <span>
#include <vector>

#include "calibrate/search/objective.h"

namespace pastefit {

/// A Gaussian process with constant mean, Matérn 5/2 covariance with one length for each coordinate, and noise.
/// Mean and variance are profiled out; lengths and noise maximise the likelihood times a broad prior that favours
/// smooth answers, so that a few dozen noisy simulations do not make it wiggle.
/// Source: Rasmussen & Williams, Gaussian Processes for Machine Learning (2006), sections 2.2, 4.2.1, 5.4.1.
class GaussianProcess {
 public:
  struct Prediction {
    double mean = 0;
    double variance = 0;  ///< of the mean answer, without the noise of one simulation
  };

  /// Shapes: n >= 1 points of the unit cube, n values. Points may repeat: that is how the noise is seen.
  GaussianProcess(std::span<const UnitPoint> points, const Eigen::VectorXd& values);

  Prediction predict(const UnitPoint& point) const;
  double noise_variance() const { return signal_variance_ * noise_ratio_; }

 private:
  class Likelihood;
  void set(const Eigen::VectorXd& lengths, double noise_ratio);

  std::vector<UnitPoint> points_;
  Eigen::VectorXd values_;
  Eigen::VectorXd lengths_;
  double noise_ratio_ = 0;      // noise variance over signal variance
  double signal_variance_ = 0;  // 0: all values are the same
  double mean_ = 0;
  double log_determinant_ = 0;
  Eigen::MatrixXd factor_;   // lower Cholesky factor of the correlation matrix with noise
  Eigen::VectorXd weights_;  // inverse correlation matrix times (values - mean)
};

/// The simulations' stand-in: answers in microseconds what the residuals of a point are likely to be.
/// The misfit is the expected one, half the sum of squared means and variances, plus the largest misfit seen times the
/// likely share of failures, so that its minimum lies where something is known and little fails. It never fails.
class Surrogate : public Objective {
 public:
  /// `seen`: finished simulations, each on one packing, at least one of them feasible.
  explicit Surrogate(std::span<const Response> seen);

  int parameters() const override { return parameters_; }
  int residuals() const override { return static_cast<int>(models_.size()); }
  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override;
  int budget_left() const override;
  bool stop_requested() const override { return false; }

  /// Likely misfit of a point and of the noise of one simulation: half the sum of the noise variances.
  double noise() const;

 private:
  int parameters_ = 0;
  double worst_ = 0;
  std::vector<GaussianProcess> models_;  // one for each residual
  std::unique_ptr<GaussianProcess> failures_;
};

/// The point of least expected misfit of the surrogate: DIRECT_L over the cube, then a local search, both by NLopt.
UnitPoint propose(Surrogate& surrogate, const UnitPoint& start);

}  // namespace pastefit
