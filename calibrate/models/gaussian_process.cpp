#include "calibrate/models/gaussian_process.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "calibrate/models/replicates.h"
#include "calibrate/optimisers/problem.h"

namespace pastefit {

double LogRange::at(double share) const {
  return low * std::pow(high / low, share);
}

double LogRange::share_of(double value) const {
  return std::clamp(std::log(value / low) / std::log(high / low), 0.0, 1.0);
}

UnitPoint fit_hyperparameters(const std::function<double(const UnitPoint&)>& deviance, const UnitPoint& start,
                              int evaluations_each) {
  const Problem problem = scalar_problem(static_cast<int>(start.size()), deviance);
  const NloptOptions options{
      .algorithm = "sbplx", .evaluations = evaluations_each * problem.parameters, .step_tolerance = 0.01};
  return minimise(problem, start, options).best.point;
}

namespace {

constexpr double default_length = 1.0;
constexpr LogRange noise_range{1e-4, 1};  // noise variance over signal variance
constexpr double default_noise = 0.01;

}  // namespace

GaussianProcess::GaussianProcess(std::span<const UnitPoint> points, const Eigen::VectorXd& values,
                                 const Eigen::VectorXd& precisions) {
  pool(points, values, precisions.size() > 0 ? precisions : Eigen::VectorXd::Ones(values.size()));
  mean_ = values.mean();
  if ((values.array() - mean_).abs().maxCoeff() <= 1e-12 * (1 + std::abs(mean_))) return;
  const Eigen::Index dimension = points_.front().size();
  const auto adopt = [&](const UnitPoint& point) {
    Eigen::VectorXd lengths(dimension);
    for (Eigen::Index k = 0; k < dimension; ++k) lengths[k] = length_range.at(point[k]);
    set(lengths, noise_range.at(point[dimension]));
  };
  const auto deviance_at = [&](const UnitPoint& point) {
    adopt(point);
    return deviance();
  };
  adopt(fit_hyperparameters(deviance_at, UnitPoint::Constant(dimension + 1, 0.5), 60));
}

double GaussianProcess::deviance() const {
  double prior = std::pow(std::log(noise_ratio_ / default_noise) / 1.5, 2);
  for (const double length : lengths_) prior += std::pow(std::log(length / default_length), 2);
  return signal_variance_ * std::exp((log_determinant_ + prior) / answers_);
}

void GaussianProcess::pool(std::span<const UnitPoint> points, const Eigen::VectorXd& values,
                           const Eigen::VectorXd& precisions) {
  const Sites sites = sites_of(points);
  points_ = sites.points;
  std::vector<Replicates> pooled(points_.size());
  for (std::size_t i = 0; i < points.size(); ++i) pooled[sites.of[i]].add(values[i], precisions[i]);
  values_.resize(std::ssize(pooled));
  counts_.resize(std::ssize(pooled));
  for (Eigen::Index i = 0; i < values_.size(); ++i) {
    const Replicates& one = pooled[i];
    values_[i] = one.mean;
    counts_[i] = one.weight;
    squares_within_ += one.squares;
  }
  answers_ = static_cast<double>(points.size());
}

void GaussianProcess::set(const Eigen::VectorXd& lengths, double noise_ratio) {
  lengths_ = lengths;
  noise_ratio_ = noise_ratio;
  const auto n = static_cast<Eigen::Index>(points_.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      matrix(i, j) = matrix(j, i) = matern_covariance(points_[i], points_[j], lengths_);
    }
    matrix(i, i) += noise_ratio_ / counts_[i];
  }
  const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
  factor_ = cholesky.matrixL();
  const Eigen::VectorXd ones = cholesky.solve(Eigen::VectorXd::Ones(n));
  mean_ = ones.dot(values_) / ones.sum();
  const Eigen::VectorXd deviations = values_.array() - mean_;
  weights_ = cholesky.solve(deviations);
  // Likelihood of all answers, from the means and the squares within the points.
  signal_variance_ = (deviations.dot(weights_) + squares_within_ / noise_ratio_) / answers_;
  log_determinant_ = 2 * factor_.diagonal().array().log().sum() + counts_.array().log().sum() +
                     (answers_ - static_cast<double>(n)) * std::log(noise_ratio_);
}

void GaussianProcess::fantasise(const UnitPoint& point, double mean, int answers) {
  if (signal_variance_ == 0) return;
  const auto n = values_.size();
  points_.push_back(point);
  values_.conservativeResize(n + 1);
  values_[n] = mean;
  counts_.conservativeResize(n + 1);
  counts_[n] = answers;
  answers_ += answers;
  set(Eigen::VectorXd(lengths_), noise_ratio_);
}

double GaussianProcess::log_likelihood() const {
  return -0.5 * (answers_ * std::log(signal_variance_) + log_determinant_);
}

GaussianProcess::Prediction GaussianProcess::predict(const UnitPoint& point) const {
  if (signal_variance_ == 0) return {mean_, 0};
  Eigen::VectorXd correlations(points_.size());
  for (Eigen::Index i = 0; i < correlations.size(); ++i) {
    correlations[i] = matern_covariance(point, points_[i], lengths_);
  }
  const double mean = mean_ + correlations.dot(weights_);
  factor_.triangularView<Eigen::Lower>().solveInPlace(correlations);
  return {mean, signal_variance_ * std::max(0.0, 1 - correlations.squaredNorm())};
}

namespace {

// Least standard deviation of the root: values that lie on a smooth curve by chance do not make the next one certain.
constexpr double least_scatter = 0.02;

// Medians of the five equally likely parts of a standard normal variable, scaled to variance 1.
constexpr std::array fifths{-1.4634, -0.5988, 0.0, 0.5988, 1.4634};

Eigen::VectorXd roots(std::span<const double> values) {
  Eigen::VectorXd out(std::ssize(values));
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = Exceedance::root(values[i]);
  return out;
}

double scatter_of(const GaussianProcess& process) {
  return std::max(process.noise_variance(), least_scatter * least_scatter);
}

double normal_cdf(double deviate) {
  return 0.5 * std::erfc(-deviate / std::sqrt(2.0));
}

}  // namespace

Exceedance::Exceedance(std::span<const UnitPoint> points, std::span<const double> values)
    : roots_(points, roots(values)) {}

double Exceedance::probability(const UnitPoint& point) const {
  const GaussianProcess::Prediction mean = roots_.predict(point);
  return normal_cdf((mean.mean - 1) / std::sqrt(scatter_of(roots_) + mean.variance));
}

double Exceedance::probability_of_at_most(int exceeding, int count, const UnitPoint& point) const {
  const GaussianProcess::Prediction mean = roots_.predict(point);
  const double deviation = std::sqrt(mean.variance), scatter = std::sqrt(scatter_of(roots_));
  double sum = 0;
  for (const double deviate : fifths) {
    const double share = normal_cdf((mean.mean + deviate * deviation - 1) / scatter);
    sum += boost::math::cdf(boost::math::binomial_distribution<>(count, share), exceeding);
  }
  return sum / static_cast<double>(fifths.size());
}

}  // namespace pastefit
