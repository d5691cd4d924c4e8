#include "calibrate/models/classifier.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "calibrate/models/matern.h"

namespace pastefit {
namespace {

constexpr double tried_lengths[] = {0.35, 0.7, 1.4, 2.8};  // of the unit cube
constexpr double tried_variances[] = {0.5, 2, 6};          // of the latent function
constexpr int most_steps = 30;

double logistic(double x) {
  return 1 / (1 + std::exp(-x));
}

double log_logistic(double x) {
  return x > 0 ? -std::log1p(std::exp(-x)) : x - std::log1p(std::exp(x));
}

}  // namespace

Classifier::Classifier(std::span<const UnitPoint> points, const std::vector<bool>& labels)
    : points_(points.begin(), points.end()), labels_(static_cast<Eigen::Index>(labels.size())) {
  for (std::size_t i = 0; i < labels.size(); ++i) labels_[static_cast<Eigen::Index>(i)] = labels[i] ? 1 : 0;
  const double share = (labels_.sum() + 0.5) / (static_cast<double>(labels.size()) + 1);  // Jeffreys' prior
  mean_ = std::log(share / (1 - share));
  double most = -std::numeric_limits<double>::infinity(), length = 1, variance = 1;
  for (const double tried_length : tried_lengths)
    for (const double tried_variance : tried_variances) {
      fit(tried_length, tried_variance);
      if (log_evidence_ <= most) continue;
      most = log_evidence_;
      length = tried_length;
      variance = tried_variance;
    }
  fit(length, variance);
}

/// Newton's method for the mode of the latent function.
void Classifier::fit(double length, double variance) {
  length_ = length;
  variance_ = variance;
  const Eigen::Index n = labels_.size();
  const Eigen::VectorXd lengths = Eigen::VectorXd::Constant(points_.front().size(), length);
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      covariance(i, j) = covariance(j, i) = matern_covariance(points_[static_cast<std::size_t>(i)],
                                                              points_[static_cast<std::size_t>(j)], lengths, variance);
  Eigen::VectorXd latent = Eigen::VectorXd::Zero(n), weights = latent;  // about the mean; inverse covariance times it
  double before = -std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd happens = (latent.array() + mean_).unaryExpr(&logistic).matrix();
    gradient_ = labels_ - happens;
    root_ = (happens.array() * (1 - happens.array())).sqrt();
    Eigen::MatrixXd matrix = root_.asDiagonal() * covariance * root_.asDiagonal();
    matrix.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    factor_ = cholesky.matrixL();
    double log_likelihood = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      log_likelihood += log_logistic((labels_[i] > 0 ? 1 : -1) * (latent[i] + mean_));
    const double objective = log_likelihood - 0.5 * weights.dot(latent);
    log_evidence_ = objective - factor_.diagonal().array().log().sum();
    if (objective - before < 1e-6) return;
    before = objective;
    const Eigen::VectorXd aim = root_.array().square() * latent.array() + gradient_.array();
    weights = aim - root_.cwiseProduct(cholesky.solve(root_.cwiseProduct(covariance * aim)));
    latent = covariance * weights;
  }
}

double Classifier::probability(const UnitPoint& point) const {
  const Eigen::VectorXd lengths = Eigen::VectorXd::Constant(point.size(), length_);
  Eigen::VectorXd covariances(labels_.size());
  for (Eigen::Index i = 0; i < covariances.size(); ++i)
    covariances[i] = matern_covariance(point, points_[static_cast<std::size_t>(i)], lengths, variance_);
  const double latent = mean_ + covariances.dot(gradient_);
  Eigen::VectorXd known = root_.cwiseProduct(covariances);
  factor_.triangularView<Eigen::Lower>().solveInPlace(known);
  const double variance = std::max(0.0, variance_ - known.squaredNorm());
  // The mean of the logistic function over the latent one (MacKay 1992).
  return logistic(latent / std::sqrt(1 + std::numbers::pi * variance / 8));
}

}  // namespace pastefit
