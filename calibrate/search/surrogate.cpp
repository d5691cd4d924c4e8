#include "calibrate/search/surrogate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/search/nlopt_search.h"

namespace pastefit {
namespace {

constexpr double shortest_length = 0.15, longest_length = 15;  // of the unit cube
constexpr double usual_length = 1.0;
constexpr double least_noise = 1e-4, most_noise = 1;  // noise variance over signal variance
constexpr double usual_noise = 0.01;

double correlation(const UnitPoint& a, const UnitPoint& b, const Eigen::VectorXd& lengths) {
  const double r = std::sqrt(5.0) * ((a - b).array() / lengths.array()).matrix().norm();
  return (1 + r + r * r / 3) * std::exp(-r);
}

double between(double low, double high, double share) {
  return low * std::pow(high / low, share);
}

/// Any packing will do where none is simulated.
const std::vector<std::uint64_t> no_packing{0};

}  // namespace

/// The fit of lengths and noise as an objective over the unit cube, so that NLopt serves here too.
class GaussianProcess::Likelihood : public Objective {
 public:
  explicit Likelihood(GaussianProcess& process) : process_(process) {}
  int parameters() const override { return static_cast<int>(process_.points_.front().size()) + 1; }
  int residuals() const override { return 0; }
  int budget_left() const override { return std::numeric_limits<int>::max(); }
  bool stop_requested() const override { return false; }

  void adopt(const UnitPoint& point) {
    const Eigen::Index dimension = point.size() - 1;
    Eigen::VectorXd lengths(dimension);
    for (Eigen::Index k = 0; k < dimension; ++k) lengths[k] = between(shortest_length, longest_length, point[k]);
    process_.set(lengths, between(least_noise, most_noise, point[dimension]));
  }

  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t>) override {
    std::vector<Response> responses;
    for (const UnitPoint& point : points) {
      adopt(point);
      const auto n = static_cast<double>(process_.values_.size());
      double prior = std::pow(std::log(process_.noise_ratio_ / usual_noise) / 1.5, 2);
      for (const double length : process_.lengths_) prior += std::pow(std::log(length / usual_length), 2);
      Response response;
      response.point = point;
      // The concentrated likelihood to the power -2/n: positive, as a misfit should be.
      response.misfit = process_.signal_variance_ * std::exp((process_.log_determinant_ + prior) / n);
      responses.push_back(std::move(response));
    }
    return responses;
  }

 private:
  GaussianProcess& process_;
};

GaussianProcess::GaussianProcess(std::span<const UnitPoint> points, const Eigen::VectorXd& values)
    : points_(points.begin(), points.end()), values_(values) {
  mean_ = values_.mean();
  if ((values_.array() - mean_).abs().maxCoeff() <= 1e-12 * (1 + std::abs(mean_))) return;
  Likelihood likelihood(*this);
  NloptOptions options;
  options.algorithm = "sbplx";
  options.evaluations = 60 * likelihood.parameters();
  options.step_tolerance = 0.01;
  const UnitPoint start = UnitPoint::Constant(likelihood.parameters(), 0.5);
  likelihood.adopt(search_nlopt(likelihood, no_packing, start, options).best.point);
}

void GaussianProcess::set(const Eigen::VectorXd& lengths, double noise_ratio) {
  lengths_ = lengths;
  noise_ratio_ = noise_ratio;
  const auto n = static_cast<Eigen::Index>(points_.size());
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      matrix(i, j) = matrix(j, i) = correlation(points_[i], points_[j], lengths_);
    }
    matrix(i, i) += noise_ratio_;
  }
  const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
  factor_ = cholesky.matrixL();
  const Eigen::VectorXd ones = cholesky.solve(Eigen::VectorXd::Ones(n));
  mean_ = ones.dot(values_) / ones.sum();
  const Eigen::VectorXd deviations = values_.array() - mean_;
  weights_ = cholesky.solve(deviations);
  signal_variance_ = deviations.dot(weights_) / static_cast<double>(n);
  log_determinant_ = 2 * factor_.diagonal().array().log().sum();
}

GaussianProcess::Prediction GaussianProcess::predict(const UnitPoint& point) const {
  if (signal_variance_ == 0) return {mean_, 0};
  Eigen::VectorXd correlations(static_cast<Eigen::Index>(points_.size()));
  for (Eigen::Index i = 0; i < correlations.size(); ++i) {
    correlations[i] = correlation(point, points_[i], lengths_);
  }
  const double mean = mean_ + correlations.dot(weights_);
  factor_.triangularView<Eigen::Lower>().solveInPlace(correlations);
  return {mean, signal_variance_ * std::max(0.0, 1 - correlations.squaredNorm())};
}

Surrogate::Surrogate(std::span<const Response> seen) : parameters_(static_cast<int>(seen.front().point.size())) {
  std::vector<UnitPoint> all, feasible;
  std::vector<Eigen::VectorXd> residuals;
  Eigen::VectorXd failed(static_cast<Eigen::Index>(seen.size()));
  for (const Response& response : seen) {
    failed[static_cast<Eigen::Index>(all.size())] = is_feasible(response) ? 0 : 1;
    all.push_back(response.point);
    if (!is_feasible(response)) continue;
    feasible.push_back(response.point);
    residuals.push_back(response.residuals);
    worst_ = std::max(worst_, response.misfit);
  }
  Eigen::VectorXd values(static_cast<Eigen::Index>(feasible.size()));
  for (Eigen::Index k = 0; k < residuals.front().size(); ++k) {
    for (std::size_t i = 0; i < residuals.size(); ++i) values[static_cast<Eigen::Index>(i)] = residuals[i][k];
    models_.emplace_back(feasible, values);
  }
  if (failed.sum() > 0) failures_ = std::make_unique<GaussianProcess>(all, failed);
}

std::vector<Response> Surrogate::evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t>) {
  std::vector<Response> responses;
  for (const UnitPoint& point : points) {
    Response response;
    response.point = point;
    response.residuals.resize(residuals());
    double variance = 0;
    for (std::size_t k = 0; k < models_.size(); ++k) {
      const GaussianProcess::Prediction prediction = models_[k].predict(point);
      response.residuals[static_cast<Eigen::Index>(k)] = prediction.mean;
      variance += prediction.variance;
    }
    const double failing = failures_ ? std::clamp(failures_->predict(point).mean, 0.0, 1.0) : 0;
    response.misfit = 0.5 * (response.residuals.squaredNorm() + variance) + failing * worst_;
    responses.push_back(std::move(response));
  }
  return responses;
}

int Surrogate::budget_left() const {
  return std::numeric_limits<int>::max();
}

double Surrogate::noise() const {
  double variance = 0;
  for (const GaussianProcess& model : models_) variance += model.noise_variance();
  return 0.5 * variance;
}

UnitPoint propose(Surrogate& surrogate, const UnitPoint& start) {
  NloptOptions options;
  options.algorithm = "direct_l";
  options.evaluations = 150 * surrogate.parameters();
  const UnitPoint rough = search_nlopt(surrogate, no_packing, start, options).best.point;
  options.algorithm = "bobyqa";
  options.initial_step = 0.1;
  return search_nlopt(surrogate, no_packing, rough, options).best.point;
}

}  // namespace pastefit
