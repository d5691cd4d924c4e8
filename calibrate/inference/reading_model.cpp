#include "calibrate/inference/reading_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "calibrate/search/nlopt_search.h"

namespace pastefit {
namespace {

// What is usual is known to a factor of two. With a longer usual length, a smaller signal or less noise few candidates
// are taken for many, and readings are stated closer than they are (tests/twins).
constexpr double shortest_length = 0.15, longest_length = 15, usual_length = 0.5;  // of the unit cube
// In variances of all answers, as the trend's.
constexpr double least_signal = 1e-3, most_signal = 10, usual_signal = 1;
constexpr double least_noise = 1e-6, most_noise = 2, usual_noise = 0.02;
constexpr double most_slope = 2.5;  // of the logarithm of the noise variance, over one standard deviation
constexpr double constant_variance = 9, slope_variance = 2;
constexpr int most_rounds = 30;  // of expectation propagation
constexpr double least_bend = 1e-9;

double between(double low, double high, double share) {
  return low * std::pow(high / low, share);
}

double share_between(double low, double high, double value) {
  return std::clamp(std::log(value / low) / std::log(high / low), 0.0, 1.0);
}

double log_normal_density(double z) {
  return -0.5 * (z * z + std::log(2 * std::numbers::pi));
}

double log_normal_share(double z) {
  return std::log(0.5 * std::erfc(-z / std::numbers::sqrt2));
}

}  // namespace

/// A bound becomes the normal observation that gives what the rest says of the mean reading (mean, doubt) the moments
/// that it has under Phi((bound - mean)/noise).
void ReadingModel::Row::match(double mean, double doubt) {
  const double total = doubt + noise * noise;
  const double z = std::clamp((value - mean) / std::sqrt(total), -30.0, 30.0);
  const double hazard = std::exp(log_normal_density(z) - log_normal_share(z));
  const double slope = -hazard / std::sqrt(total);
  const double bend = std::max(hazard * (z + hazard) / total, least_bend);
  observed = mean + slope / bend;
  variance = std::max(1 / bend - doubt, least_bend);
  log_weight = log_normal_share(z) + 0.5 * (std::log(2 * std::numbers::pi / bend) + slope * slope / bend);
}

/// The fit of the settings as an objective over the unit cube, so that NLopt serves here too.
class ReadingModel::Fit : public Objective {
 public:
  /// `with_places`: the noise may depend on the mean reading.
  Fit(ReadingModel& model, bool with_places) : model_(model), with_places_(with_places) {}

  int parameters() const override { return dimension() + (with_places_ ? 4 : 2); }
  int residuals() const override { return 0; }
  int budget_left() const override { return std::numeric_limits<int>::max(); }
  bool stop_requested() const override { return false; }

  UnitPoint point_of(const Settings& settings) const {
    UnitPoint point = UnitPoint::Constant(parameters(), 0.5);
    const Eigen::Index d = dimension();
    for (Eigen::Index k = 0; k < d; ++k) point[k] = share_between(shortest_length, longest_length, settings.lengths[k]);
    point[d] = share_between(least_signal, most_signal, settings.signal_variance);
    point[d + 1] = share_between(least_noise, most_noise, std::exp(settings.noise_level));
    return point;
  }

  Settings settings_at(const UnitPoint& point) const {
    Settings settings;
    const Eigen::Index d = dimension();
    settings.lengths.resize(d);
    for (Eigen::Index k = 0; k < d; ++k) settings.lengths[k] = between(shortest_length, longest_length, point[k]);
    settings.signal_variance = between(least_signal, most_signal, point[d]);
    settings.noise_level = std::log(between(least_noise, most_noise, point[d + 1]));
    if (!with_places_) return settings;
    settings.noise_slope = most_slope * (2 * point[d + 2] - 1);
    settings.noise_bend = most_slope * (2 * point[d + 3] - 1);
    return settings;
  }

  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t>) override {
    std::vector<Response> responses;
    for (const UnitPoint& point : points) {
      const Settings settings = settings_at(point);
      model_.adopt(settings);
      const auto off = [](double value, double usual) {
        return 0.5 * std::pow(std::log(value / usual) / std::numbers::ln2, 2);
      };
      double prior = off(settings.signal_variance, usual_signal) + off(std::exp(settings.noise_level), usual_noise) +
                     0.5 * (std::pow(settings.noise_slope, 2) + std::pow(settings.noise_bend, 2));
      for (const double length : settings.lengths) prior += off(length, usual_length);
      double answers = 0;
      for (const Row& row : model_.rows_) answers += row.count;
      Response response;
      response.point = point;
      response.misfit = std::exp(2 * (prior - model_.log_evidence_) / answers);  // positive, as a misfit should be
      responses.push_back(std::move(response));
    }
    return responses;
  }

  /// Adopts the settings of most evidence.
  void maximise(const UnitPoint& start, int evaluations_each) {
    NloptOptions options;
    options.algorithm = "sbplx";
    options.evaluations = evaluations_each * parameters();
    options.step_tolerance = 0.01;
    const std::vector<std::uint64_t> no_packing{0};
    model_.adopt(settings_at(search_nlopt(*this, no_packing, start, options).best.point));
  }

 private:
  int dimension() const { return static_cast<int>(model_.sites_.front().size()); }

  ReadingModel& model_;
  bool with_places_;
};

ReadingModel::ReadingModel(std::span<const UnitPoint> sites, std::span<const Answer> answers)
    : sites_(sites.begin(), sites.end()) {
  pool(answers);
  standardise();
  if (scale_ == 0) return;
  levels_ = Eigen::VectorXd::Zero(std::ssize(rows_));
  Fit even(*this, false);
  even.maximise(UnitPoint::Constant(even.parameters(), 0.5), 60);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    levels_[static_cast<Eigen::Index>(i)] = (predict(place(i)).mean - centre_) / scale_;
  Fit uneven(*this, true);
  uneven.maximise(uneven.point_of(settings_), 40);
  for (Row& row : rows_) row.noise *= scale_;
}

void ReadingModel::pool(std::span<const Answer> answers) {
  for (const Answer& answer : answers) {
    const auto same = [&](const Row& row) { return row.site == answer.site && !row.is_bound; };
    const auto known = answer.is_bound ? rows_.end() : std::ranges::find_if(rows_, same);
    if (known == rows_.end()) {
      rows_.push_back({.site = answer.site, .is_bound = answer.is_bound, .value = answer.value});
      continue;
    }
    // Welford's update: without cancellation.
    known->count += 1;
    const double before = answer.value - known->value;
    known->value += before / known->count;
    known->squares += before * (answer.value - known->value);
  }
}

void ReadingModel::standardise() {
  const auto count = static_cast<double>(rows_.size());
  for (const Row& row : rows_) centre_ += row.value / count;
  for (const Row& row : rows_) scale_ += std::pow(row.value - centre_, 2) / count;
  scale_ = std::sqrt(scale_);
  if (scale_ <= 1e-12 * (1 + std::abs(centre_))) scale_ = 0;
  if (scale_ == 0) return;
  lowest_ = std::numeric_limits<double>::infinity();
  highest_ = -lowest_;
  for (Row& row : rows_) {
    row.observed = row.value = (row.value - centre_) / scale_;
    row.squares /= scale_ * scale_;
    lowest_ = std::min(lowest_, row.value);
    highest_ = std::max(highest_, row.value);
  }
}

double ReadingModel::covariance(const UnitPoint& a, const UnitPoint& b) const {
  const double r = std::sqrt(5.0) * ((a - b).array() / settings_.lengths.array()).matrix().norm();
  const double trend =
      constant_variance + slope_variance * (2 * a.array() - 1).matrix().dot((2 * b.array() - 1).matrix());
  return trend + settings_.signal_variance * (1 + r + r * r / 3) * std::exp(-r);
}

double ReadingModel::noise_variance(double mean) const {
  const double u = std::clamp(mean, lowest_, highest_);
  return std::max(least_noise,
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
    for (Eigen::Index j = 0; j <= i; ++j)
      prior(i, j) = prior(j, i) = covariance(place(static_cast<std::size_t>(i)), place(static_cast<std::size_t>(j)));

  double log_within = 0;  // likelihood of the answers about the means of their rows
  for (Eigen::Index i = 0; i < n; ++i) {
    Row& row = rows_[static_cast<std::size_t>(i)];
    const double noise = noise_variance(levels_[i]);
    row.noise = std::sqrt(noise);
    if (row.is_bound) continue;
    row.variance = noise / row.count;
    log_within -=
        0.5 * ((row.count - 1) * std::log(2 * std::numbers::pi * noise) + row.squares / noise + std::log(row.count));
  }
  Eigen::LLT<Eigen::MatrixXd> cholesky;
  Eigen::VectorXd observed(n);
  for (int round = 0; round < most_rounds; ++round) {
    Eigen::MatrixXd matrix = prior;
    for (Eigen::Index i = 0; i < n; ++i) {
      matrix(i, i) += rows_[static_cast<std::size_t>(i)].variance;
      observed[i] = rows_[static_cast<std::size_t>(i)].observed;
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
    Row& row = rows_[static_cast<std::size_t>(i)];
    if (!row.is_bound) continue;
    const Row before = row;
    const double mean = prior.col(i).dot(weights_);
    const double doubt = std::max(prior(i, i) - prior.col(i).dot(cholesky.solve(prior.col(i))), least_bend);
    const double rest = std::max(1 / doubt - 1 / row.variance, least_bend);  // precision, without this bound
    row.match((mean / doubt - row.observed / row.variance) / rest, 1 / rest);
    change = std::max({change, std::abs(1 / row.variance - 1 / before.variance) * doubt,
                       std::abs(row.observed / row.variance - before.observed / before.variance) * std::sqrt(doubt)});
  }
  return change;
}

ReadingModel::Prediction ReadingModel::predict(const UnitPoint& point) const {
  if (scale_ == 0) return {centre_, 0, Eigen::VectorXd::Zero(std::ssize(rows_))};
  Eigen::VectorXd covariances(std::ssize(rows_));
  for (std::size_t i = 0; i < rows_.size(); ++i)
    covariances[static_cast<Eigen::Index>(i)] = covariance(point, place(i));
  Prediction out;
  out.weights.noalias() = inverse_ * covariances;
  out.mean = centre_ + scale_ * covariances.dot(weights_);
  out.variance = scale_ * scale_ * std::max(0.0, covariance(point, point) - covariances.dot(out.weights));
  return out;
}

double ReadingModel::noise_at(double mean) const {
  return scale_ == 0 ? 0 : scale_ * std::sqrt(noise_variance((mean - centre_) / scale_));
}

}  // namespace pastefit
