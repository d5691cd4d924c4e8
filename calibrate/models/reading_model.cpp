#include "calibrate/models/reading_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "calibrate/models/gaussian_process.h"

namespace pastefit {
namespace {

// Log-normal priors; one standard deviation is a factor of two. Longer typical lengths, a smaller signal or less noise
// would make the model overconfident between few candidates (tests/twins).
constexpr double typical_length = 0.5;
// In units of the variance of all rows, as are the variances of the trend.
constexpr LogRange signal_range{1e-3, 10}, noise_variance_range{1e-6, 2};
constexpr double typical_signal = 1, typical_noise = 0.02;
constexpr double most_slope = 2.5;  // of the logarithm of the noise variance, over one standard deviation
constexpr double constant_variance = 9, slope_variance = 2;
constexpr int most_rounds = 30;  // of expectation propagation
constexpr double least_bend = 1e-9;

double log_normal_density(double z) {
  return -0.5 * (z * z + std::log(2 * std::numbers::pi));
}

double log_normal_share(double z) {
  return std::log(0.5 * std::erfc(-z / std::numbers::sqrt2));
}

}  // namespace

/// Moment matching. Without the bound, the mean reading m is normal with (mean, `predictive_variance`). The normal
/// observation gives m the mean and variance that m has under the likelihood Phi((bound - m)/noise).
void ReadingModel::Row::match(double mean, double predictive_variance) {
  const double total = predictive_variance + noise * noise;
  const double z = std::clamp((answers.mean - mean) / std::sqrt(total), -30.0, 30.0);
  const double hazard = std::exp(log_normal_density(z) - log_normal_share(z));
  const double slope = -hazard / std::sqrt(total);
  const double bend = std::max(hazard * (z + hazard) / total, least_bend);
  observed = mean + slope / bend;
  variance = std::max(1 / bend - predictive_variance, least_bend);
  log_weight = log_normal_share(z) + 0.5 * (std::log(2 * std::numbers::pi / bend) + slope * slope / bend);
}

UnitPoint ReadingModel::point_of(const Settings& settings, bool with_places) const {
  const Eigen::Index d = dimension();
  UnitPoint point = UnitPoint::Constant(d + (with_places ? 4 : 2), 0.5);
  for (Eigen::Index k = 0; k < d; ++k) point[k] = length_range.share_of(settings.lengths[k]);
  point[d] = signal_range.share_of(settings.signal_variance);
  point[d + 1] = noise_variance_range.share_of(std::exp(settings.noise_level));
  return point;
}

ReadingModel::Settings ReadingModel::settings_at(const UnitPoint& point, bool with_places) const {
  Settings settings;
  const Eigen::Index d = dimension();
  settings.lengths.resize(d);
  for (Eigen::Index k = 0; k < d; ++k) settings.lengths[k] = length_range.at(point[k]);
  settings.signal_variance = signal_range.at(point[d]);
  settings.noise_level = std::log(noise_variance_range.at(point[d + 1]));
  if (!with_places) return settings;
  settings.noise_slope = most_slope * (2 * point[d + 2] - 1);
  settings.noise_bend = most_slope * (2 * point[d + 3] - 1);
  return settings;
}

double ReadingModel::deviance() const {
  const auto off = [](double value, double by_default) {
    return 0.5 * std::pow(std::log(value / by_default) / std::numbers::ln2, 2);
  };
  double prior = off(settings_.signal_variance, typical_signal) + off(std::exp(settings_.noise_level), typical_noise) +
                 0.5 * (std::pow(settings_.noise_slope, 2) + std::pow(settings_.noise_bend, 2));
  for (const double length : settings_.lengths) prior += off(length, typical_length);
  double answers = 0;
  for (const Row& row : rows_) answers += row.answers.weight;
  return std::exp(2 * (prior - log_evidence_) / answers);
}

void ReadingModel::fit(const UnitPoint& start, bool with_places, int evaluations_each) {
  const auto deviance_at = [&](const UnitPoint& point) {
    adopt(settings_at(point, with_places));
    return deviance();
  };
  adopt(settings_at(fit_hyperparameters(deviance_at, start, evaluations_each), with_places));
}

ReadingModel::ReadingModel(std::span<const UnitPoint> sites, std::span<const Answer> answers)
    : sites_(sites.begin(), sites.end()) {
  pool(answers);
  standardise();
  if (scale_ == 0) return;
  levels_ = Eigen::VectorXd::Zero(std::ssize(rows_));
  fit(UnitPoint::Constant(dimension() + 2, 0.5), false, 60);
  for (std::size_t i = 0; i < rows_.size(); ++i) levels_[i] = (predict(place(i)).mean - centre_) / scale_;
  fit(point_of(settings_, true), true, 40);
  for (Row& row : rows_) row.noise *= scale_;
}

void ReadingModel::pool(std::span<const Answer> answers) {
  for (const Answer& answer : answers) {
    const auto same = [&](const Row& row) { return row.site == answer.site && !row.is_bound; };
    const auto known = answer.is_bound ? rows_.end() : std::ranges::find_if(rows_, same);
    Row& row =
        known == rows_.end() ? rows_.emplace_back(Row{.site = answer.site, .is_bound = answer.is_bound}) : *known;
    row.answers.add(answer.value);
  }
}

void ReadingModel::standardise() {
  const auto count = static_cast<double>(rows_.size());
  for (const Row& row : rows_) centre_ += row.answers.mean / count;
  for (const Row& row : rows_) scale_ += std::pow(row.answers.mean - centre_, 2) / count;
  scale_ = std::sqrt(scale_);
  if (scale_ <= 1e-12 * (1 + std::abs(centre_))) scale_ = 0;
  if (scale_ == 0) return;
  lowest_ = std::numeric_limits<double>::infinity();
  highest_ = -lowest_;
  for (Row& row : rows_) {
    row.observed = row.answers.mean = (row.answers.mean - centre_) / scale_;
    row.answers.squares /= scale_ * scale_;
    lowest_ = std::min(lowest_, row.answers.mean);
    highest_ = std::max(highest_, row.answers.mean);
  }
}

double ReadingModel::covariance(const UnitPoint& a, const UnitPoint& b) const {
  const double trend =
      constant_variance + slope_variance * (2 * a.array() - 1).matrix().dot((2 * b.array() - 1).matrix());
  return trend + matern_covariance(a, b, settings_.lengths, settings_.signal_variance);
}

double ReadingModel::noise_variance(double mean) const {
  const double u = std::clamp(mean, lowest_, highest_);
  return std::max(noise_variance_range.low,
                  std::exp(settings_.noise_level + settings_.noise_slope * u + settings_.noise_bend * (u * u - 1)));
}

void ReadingModel::adopt(const Settings& settings) {
  settings_ = settings;
  condition();
}

void ReadingModel::condition() {
  const auto n = static_cast<Eigen::Index>(rows_.size());
  Eigen::MatrixXd prior(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) prior(i, j) = prior(j, i) = covariance(place(i), place(j));

  double log_within = 0;  // log-likelihood of the answers about the means of their rows
  for (Eigen::Index i = 0; i < n; ++i) {
    Row& row = rows_[i];
    const double noise = noise_variance(levels_[i]);
    row.noise = std::sqrt(noise);
    if (row.is_bound) continue;
    row.variance = noise / row.answers.weight;
    log_within -= 0.5 * ((row.answers.weight - 1) * std::log(2 * std::numbers::pi * noise) +
                         row.answers.squares / noise + std::log(row.answers.weight));
  }
  Eigen::LLT<Eigen::MatrixXd> cholesky;
  Eigen::VectorXd observed(n);
  for (int round = 0; round < most_rounds; ++round) {
    Eigen::MatrixXd matrix = prior;
    for (Eigen::Index i = 0; i < n; ++i) {
      matrix(i, i) += rows_[i].variance;
      observed[i] = rows_[i].observed;
    }
    cholesky.compute(matrix);
    weights_ = cholesky.solve(observed);
    if (propagate(prior, cholesky) < 1e-4) break;
  }
  inverse_ = cholesky.solve(Eigen::MatrixXd::Identity(n, n));
  log_evidence_ = log_within -
                  0.5 * (observed.dot(weights_) + static_cast<double>(n) * std::log(2 * std::numbers::pi)) -
                  Eigen::MatrixXd(cholesky.matrixL()).diagonal().array().log().sum();
  for (const Row& row : rows_) log_evidence_ += row.log_weight;
}

double ReadingModel::propagate(const Eigen::MatrixXd& prior, const Eigen::LLT<Eigen::MatrixXd>& cholesky) {
  double change = 0;
  for (Eigen::Index i = 0; i < prior.rows(); ++i) {
    Row& row = rows_[i];
    if (!row.is_bound) continue;
    const Row before = row;
    const double mean = prior.col(i).dot(weights_);
    const double predictive_variance =
        std::max(prior(i, i) - prior.col(i).dot(cholesky.solve(prior.col(i))), least_bend);
    const double rest =
        std::max(1 / predictive_variance - 1 / row.variance, least_bend);  // precision, without this bound
    row.match((mean / predictive_variance - row.observed / row.variance) / rest, 1 / rest);
    change = std::max(
        {change, std::abs(1 / row.variance - 1 / before.variance) * predictive_variance,
         std::abs(row.observed / row.variance - before.observed / before.variance) * std::sqrt(predictive_variance)});
  }
  return change;
}

ReadingModel::Prediction ReadingModel::predict(const UnitPoint& point) const {
  if (scale_ == 0) return {centre_, 0, Eigen::VectorXd::Zero(std::ssize(rows_))};
  Prediction out = conditional(covariances(point), covariance(point, point));
  out.mean += centre_;
  return out;
}

ReadingModel::Prediction ReadingModel::change(const UnitPoint& from, const UnitPoint& to) const {
  if (scale_ == 0) return {0, 0, Eigen::VectorXd::Zero(std::ssize(rows_))};
  return conditional(covariances(to) - covariances(from),
                     covariance(to, to) + covariance(from, from) - 2 * covariance(from, to));
}

Eigen::VectorXd ReadingModel::covariances(const UnitPoint& point) const {
  Eigen::VectorXd out(std::ssize(rows_));
  for (std::size_t i = 0; i < rows_.size(); ++i) out[i] = covariance(point, place(i));
  return out;
}

ReadingModel::Prediction ReadingModel::conditional(const Eigen::VectorXd& covariances, double variance) const {
  Prediction out;
  out.weights.noalias() = inverse_ * covariances;
  out.mean = scale_ * covariances.dot(weights_);
  out.variance = scale_ * scale_ * std::max(0.0, variance - covariances.dot(out.weights));
  return out;
}

std::vector<double> ReadingModel::leave_one_out() const {
  std::vector<double> out(rows_.size(), 0);
  if (scale_ == 0) return out;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (!rows_[i].is_bound) out[i] = scale_ * weights_[i] / inverse_(i, i);
  return out;
}

double ReadingModel::noise_at(double mean) const {
  return scale_ == 0 ? 0 : scale_ * std::sqrt(noise_variance((mean - centre_) / scale_));
}

}  // namespace pastefit
