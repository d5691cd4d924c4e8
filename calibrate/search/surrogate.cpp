#include "calibrate/search/surrogate.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

#include "calibrate/evaluate/response.h"
#include "calibrate/optimisers/problem.h"

namespace pastefit {
namespace {

/// Among equally good candidates the one nearer to the middle of the bounds is more plausible: each coordinate has a
/// normal prior of this weight about the middle, with half the range as standard deviation.
constexpr double weight_of_middle = 0.1;

constexpr double least_share = 0.05;  // of rejected heaps; smaller shares are indistinguishable from 0

/// Packings of a confirmation; an error of half a tolerance in their mean is harmless.
constexpr double packings_of_a_mean = 8;
constexpr double harmless_share = 0.5;

/// Tolerances beyond which residuals may be compressed.
constexpr double far_off = 4;

/// Logarithmic beyond `far`, with continuous slope. Whether a heap that keeps its shape misses by 200 or 210 mm does
/// not matter, and a model that follows the cliff is less accurate near the measurement.
double compressed(double residual, double far) {
  if (std::abs(residual) <= far) return residual;
  return std::copysign(far * (1 + std::log(std::abs(residual) / far)), residual);
}

}  // namespace

Surrogate::Surrogate(std::span<const Response> seen, const Eigen::VectorXd& tolerances, double rejected_share) {
  learn_rejections(seen, tolerances, rejected_share);
  std::vector<UnitPoint> all;
  std::vector<const Response*> feasible, learnt;
  Eigen::VectorXd failed(seen.size());
  for (const Response& response : seen) {
    failed[all.size()] = is_feasible(response) ? 0 : 1;
    all.push_back(response.point);
    if (!is_feasible(response)) continue;
    feasible.push_back(&response);
    worst_ = std::max(worst_, response.misfit);
    if (response.rejected == 0) learnt.push_back(&response);
  }
  if (learnt.empty()) learnt = feasible;
  for (Eigen::Index k = 0; k < feasible.front()->residuals.size(); ++k) {
    const double tolerance = k < tolerances.size() ? tolerances[k] : 0;
    std::vector<UnitPoint> points;
    std::vector<double> values;
    for (const Response* response : learnt) {
      if (!has_reading(*response, k)) continue;
      points.push_back(response->point);
      values.push_back(response->residuals[k]);
    }
    models_.emplace_back();
    replicate_variances_.emplace_back();
    if (!points.empty()) learn(points, Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)), tolerance);
  }
  if (failed.sum() > 0) failures_.emplace(all, failed);
}

/// Compression helps readings with a cliff and distorts smooth ones: if all were compressed, two searches met neither
/// concrete mix 66 nor the two-step twin.
void Surrogate::compress_if_likelier(const std::vector<UnitPoint>& points, Eigen::VectorXd& values, double far) {
  if (values.cwiseAbs().maxCoeff() <= far) return;
  const Eigen::VectorXd nearer = values.unaryExpr([&](double residual) { return compressed(residual, far); });
  const GaussianProcess model_of_nearer(points, nearer);
  // Likelihood of the uncompressed residuals: that of the compressed ones times the derivative of the compression.
  const double slopes = (far / values.array().abs()).min(1).log().sum();
  std::optional<GaussianProcess>& model = models_.back();
  if (model_of_nearer.log_likelihood() + slopes <= model->log_likelihood()) return;
  model = model_of_nearer;
  values = nearer;
}

/// Trains twice: the first fit gives the scatter between packings, the second uses it as precisions, so that
/// simulations where packings scatter get less weight.
void Surrogate::learn(const std::vector<UnitPoint>& points, Eigen::VectorXd values, double tolerance) {
  std::optional<GaussianProcess>& model = models_.back();
  std::optional<ReplicateVariance>& variance = replicate_variances_.back();
  model.emplace(points, values);
  if (tolerance <= 0) return;
  compress_if_likelier(points, values, far_off * tolerance);
  Eigen::VectorXd precisions(values.size());
  const auto learn_replicate_variance = [&] {
    Eigen::VectorXd deviations = values;
    for (std::size_t i = 0; i < points.size(); ++i) deviations[i] -= model->predict(points[i]).mean;
    variance.emplace(points, deviations, packings_of_a_mean * std::pow(harmless_share * tolerance, 2));
    for (std::size_t i = 0; i < points.size(); ++i) precisions[i] = variance->precision(points[i]);
  };
  learn_replicate_variance();
  if (precisions.minCoeff() == 1) return;
  model.emplace(points, values, precisions);
  learn_replicate_variance();
}

double Surrogate::variance_of_mean(std::size_t residual, const UnitPoint& point) const {
  return replicate_variances_[residual] ? replicate_variances_[residual]->excess(point) / packings_of_a_mean : 0;
}

Eigen::VectorXd Surrogate::expected_residuals(const UnitPoint& point) const {
  Eigen::VectorXd expected(residuals());
  for (std::size_t k = 0; k < models_.size(); ++k) expected[k] = models_[k] ? models_[k]->predict(point).mean : 0;
  return expected;
}

Surrogate::MisfitPosterior Surrogate::misfit_posterior(const UnitPoint& point) const {
  const double odd = 0.5 * weight_of_middle * (2 * point.array() - 1).square().sum();
  double certain = rejected_misfit_ * std::pow(rejecting(point), 2), mean = odd + failing(point) * worst_, variance = 0;
  for (std::size_t k = 0; k < models_.size(); ++k) {
    if (!models_[k]) continue;
    const GaussianProcess::Prediction residual = models_[k]->predict(point);
    const double square = residual.mean * residual.mean;
    certain += 0.5 * variance_of_mean(k, point);
    mean += 0.5 * (square + residual.variance);
    variance += residual.variance * (0.5 * residual.variance + square);
  }
  return {certain, mean, variance};
}

void Surrogate::learn_rejections(std::span<const Response> seen, const Eigen::VectorXd& tolerances,
                                 double rejected_share) {
  if (rejected_share >= 1) return;
  std::vector<UnitPoint> points;
  std::vector<double> indices;
  for (const Response& one : seen)
    for (const Evaluation& evaluation : one.evaluations) {
      if (evaluation.failure || evaluation.censored || std::isnan(evaluation.rejection_index)) continue;
      points.push_back(one.point);
      indices.push_back(evaluation.rejection_index);
    }
  if (points.empty()) return;
  rejections_.emplace(points, indices);
  const double judged = static_cast<double>((tolerances.array() > 0).count());
  const double allowed = judged > 0 ? tolerances.squaredNorm() / judged : 1;
  rejected_misfit_ = 0.5 * allowed / std::pow(std::max(rejected_share, least_share), 2);
}

double Surrogate::rejecting(const UnitPoint& point) const {
  return rejections_ ? rejections_->probability(point) : 0;
}

double Surrogate::accepted(const UnitPoint& point, int rejected, int heaps) const {
  return rejections_ ? rejections_->probability_of_at_most(rejected, heaps, point) : 1;
}

double Surrogate::failing(const UnitPoint& point) const {
  return failures_ ? std::clamp(failures_->predict(point).mean, 0.0, 1.0) : 0;
}

std::vector<double> Surrogate::within(std::span<const Eigen::VectorXd> bounds, const UnitPoint& point) const {
  std::vector<double> probabilities(bounds.size(), 1 - failing(point));
  for (std::size_t k = 0; k < models_.size(); ++k) {
    const auto bound_of = [&](const Eigen::VectorXd& some) { return some[k]; };
    if (!models_[k] || std::ranges::all_of(bounds, [&](const auto& some) { return bound_of(some) == 0; })) continue;
    const GaussianProcess::Prediction residual = models_[k]->predict(point);
    const double scale = std::sqrt(2 * std::max(residual.variance, std::numeric_limits<double>::min()));
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      const double bound = bound_of(bounds[i]);
      if (bound == 0) continue;
      probabilities[i] *= 0.5 * (std::erf((bound - residual.mean) / scale) + std::erf((bound + residual.mean) / scale));
    }
  }
  return probabilities;
}

double Surrogate::MisfitPosterior::improvement(double bound) const {
  bound -= fixed;
  if (bound <= 0) return 0;
  constexpr double narrow =
      1e8;  // shape beyond which the gamma distribution is a point mass, and its series do not converge
  const double shape = uncertain_mean * uncertain_mean / variance, place = bound * uncertain_mean / variance;
  if (!(shape < narrow)) return std::max(0.0, bound - uncertain_mean);
  return std::max(0.0,
                  bound * boost::math::gamma_p(shape, place) - uncertain_mean * boost::math::gamma_p(shape + 1, place));
}

void Surrogate::fantasise(const UnitPoint& point, const Eigen::VectorXd& deviates) {
  for (std::size_t k = 0; k < models_.size(); ++k) {
    if (!models_[k]) continue;
    const GaussianProcess::Prediction prediction = models_[k]->predict(point);
    const double deviate = deviates[k];
    models_[k]->fantasise(point, prediction.mean + deviate * std::sqrt(prediction.variance), 1);
  }
}

double Surrogate::noise() const {
  double variance = 0;
  for (const auto& model : models_) variance += model ? model->noise_variance() : 0;
  return 0.5 * variance;
}

Improvement maximise_expected_improvement(const Surrogate& surrogate, double misfit, const UnitPoint& start) {
  constexpr double slope = 1e-4;  // leads out of regions without expected improvement
  const auto expected_least = [&](const UnitPoint& point) {
    const Surrogate::MisfitPosterior misfit_posterior = surrogate.misfit_posterior(point);
    return misfit - misfit_posterior.improvement(misfit) + slope * misfit_posterior.mean();
  };
  const UnitPoint point = least_point(expected_least, start);
  return {point, surrogate.misfit_posterior(point).improvement(misfit)};
}

std::vector<std::uint64_t> packings_of_coarse(std::uint64_t seed, int count) {
  std::vector<std::uint64_t> packings;
  for (int k = 0; k < count; ++k) packings.push_back(coarse_packings + seed * 1000 + static_cast<std::uint64_t>(k));
  return packings;
}

namespace {

/// Coarse grains shear off more often than fine ones: scales their rejection indices by the mean ratio of the roots.
void correct_rejections(std::vector<Response>& coarse, std::span<const Response> fine) {
  const auto root = [](const Response& one) { return Exceedance::root(one.evaluations.front().rejection_index); };
  std::vector<UnitPoint> points;
  std::vector<double> roots;
  for (const Response& one : coarse) {
    if (one.censored || one.evaluations.empty() || std::isnan(one.evaluations.front().rejection_index)) continue;
    points.push_back(one.point);
    roots.push_back(root(one));
  }
  if (points.empty()) return;
  const GaussianProcess of_coarse(points, Eigen::Map<const Eigen::VectorXd>(roots.data(), std::ssize(roots)));
  double of_fine = 0, expected = 0;
  for (const Response& one : fine) {
    if (!is_whole(one) || one.evaluations.empty() || std::isnan(one.evaluations.front().rejection_index)) continue;
    of_fine += root(one);
    expected += of_coarse.predict(one.point).mean;
  }
  if (of_fine <= 0 || expected <= 0) return;
  for (Response& one : coarse)
    if (!one.evaluations.empty()) one.evaluations.front().rejection_index *= std::pow(of_fine / expected, 2);
}

}  // namespace

std::vector<Response> corrected(std::span<const Response> coarse, std::span<const Response> fine) {
  std::vector<Response> moved;
  for (const Response& one : coarse)
    if (is_feasible(one)) moved.push_back(one);
  if (moved.empty()) return moved;
  Surrogate surrogate(moved);
  Eigen::VectorXd bias = Eigen::VectorXd::Zero(moved.front().residuals.size());
  int count = 0;
  for (const Response& one : fine) {
    if (!is_feasible(one)) continue;
    bias += one.residuals - surrogate.expected_residuals(one.point);
    ++count;
  }
  if (count > 0) bias /= count;
  for (Response& one : moved) {
    one.residuals += bias;
    one.misfit = 0.5 * one.residuals.squaredNorm();
  }
  correct_rejections(moved, fine);
  return moved;
}

}  // namespace pastefit
