#include "calibrate/inference/posterior.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "calibrate/laboratory/test.h"
#include "calibrate/search/screening.h"
#include "core/random.h"

namespace pastefit {

namespace {

constexpr double kept_share = 0.5;  // effective sample size kept from one power of the likelihood to the next
constexpr int walk_steps = 6;       // after each resampling
constexpr int most_powers = 200;

/// Sample while the power of the likelihood grows from 0 to 1.
class Population {
 public:
  Population(const std::function<double(const UnitPoint&)>& log_likelihood, int dimension, int count,
             std::uint64_t seed)
      : log_likelihood_(log_likelihood),
        random_(seed, "posterior"),
        members_(screening_points(dimension, count, seed)) {
    for (const UnitPoint& member : members_) values_.push_back(likelihood_at(member));
  }

  std::vector<UnitPoint> run() {
    double power = 0;
    for (int k = 0; k < most_powers && power < 1; ++k) {
      const double next = next_power(power);
      redraw(next - power);
      power = next;
      walk(power);
    }
    return std::move(members_);
  }

 private:
  double draw() { return random_.uniform(drawn_++); }

  /// Log-likelihood; one that is not finite counts as zero likelihood.
  double likelihood_at(const UnitPoint& point) const {
    const double value = log_likelihood_(point);
    return std::isfinite(value) ? value : -1e300;
  }

  std::vector<double> weights(double step) const {
    const double most = *std::ranges::max_element(values_);
    std::vector<double> weights;
    for (const double value : values_) weights.push_back(std::exp(step * (value - most)));
    return weights;
  }

  /// Effective size of the weighted sample, as a share of its size (Kish).
  double effective_share(double step) const {
    double sum = 0, squares = 0;
    for (const double weight : weights(step)) {
      sum += weight;
      squares += weight * weight;
    }
    return sum * sum / squares / static_cast<double>(values_.size());
  }

  double next_power(double power) const {
    if (effective_share(1 - power) >= kept_share) return 1;
    double low = 0, high = 1 - power;
    for (int k = 0; k < 40; ++k) {
      const double middle = (low + high) / 2;
      (effective_share(middle) >= kept_share ? low : high) = middle;
    }
    return power + std::max(low, 1e-4);
  }

  /// Systematic resampling: one random number for all members.
  void redraw(double step) {
    const std::vector<double> share = weights(step);
    double sum = 0;
    for (const double weight : share) sum += weight;
    std::vector<UnitPoint> members;
    std::vector<double> values;
    double reached = 0, target = draw() * sum / static_cast<double>(share.size());
    for (std::size_t i = 0; i < share.size(); ++i) {
      reached += share[i];
      for (; members.size() < share.size() && target <= reached; target += sum / static_cast<double>(share.size())) {
        members.push_back(members_[i]);
        values.push_back(values_[i]);
      }
    }
    for (; members.size() < share.size(); values.push_back(values.back())) members.push_back(members.back());
    members_ = std::move(members);
    values_ = std::move(values);
  }

  /// Random walks by Metropolis, reflected at the borders.
  void walk(double power) {
    const auto dimension = members_.front().size();
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(dimension);
    for (const UnitPoint& member : members_) mean += member / static_cast<double>(members_.size());
    Eigen::MatrixXd covariance = 1e-10 * Eigen::MatrixXd::Identity(dimension, dimension);
    for (const UnitPoint& member : members_)
      covariance += (member - mean) * (member - mean).transpose() / static_cast<double>(members_.size());
    const double scale = 2.38 / std::sqrt(static_cast<double>(dimension));  // Roberts, Gelman & Gilks 1997
    const Eigen::MatrixXd spread = scale * Eigen::MatrixXd(covariance.llt().matrixL());
    for (int step = 0; step < walk_steps; ++step) {
      const double width = step % 2 == 0 ? 1 : 0.3;  // narrow steps too: wide ones leave a curved ridge
      for (std::size_t i = 0; i < members_.size(); ++i) {
        Eigen::VectorXd normals(dimension);
        for (double& normal : normals) normal = random_normal();
        UnitPoint candidate = members_[i] + width * spread * normals;
        for (double& x : candidate) x = reflected(x);
        const double value = likelihood_at(candidate);
        if (std::log(std::max(draw(), 1e-300)) > power * (value - values_[i])) continue;
        members_[i] = std::move(candidate);
        values_[i] = value;
      }
    }
  }

  double random_normal() {
    const double radius = std::sqrt(-2 * std::log(std::max(draw(), 1e-300)));
    return radius * std::cos(2 * 3.14159265358979323846 * draw());
  }

  static double reflected(double x) {
    const double folded = std::abs(std::remainder(x, 2.0));
    return std::clamp(folded, 0.0, 1.0);
  }

  const std::function<double(const UnitPoint&)>& log_likelihood_;
  RandomStream random_;
  std::uint64_t drawn_ = 0;
  std::vector<UnitPoint> members_;
  std::vector<double> values_;
};

}  // namespace

std::vector<UnitPoint> posterior_sample(const std::function<double(const UnitPoint&)>& log_likelihood, int dimension,
                                        int count, std::uint64_t seed) {
  if (dimension < 1 || count < 2) throw std::logic_error("posterior_sample: needs dimension >= 1 and count >= 2");
  return Population(log_likelihood, dimension, count, seed).run();
}

Moments moments_of(const std::vector<UnitPoint>& sample) {
  const auto dimension = sample.front().size();
  const auto count = static_cast<double>(sample.size());
  Moments out{Eigen::VectorXd::Zero(dimension), Eigen::MatrixXd::Zero(dimension, dimension)};
  for (const UnitPoint& member : sample) out.mean += member / count;
  for (const UnitPoint& member : sample)
    out.covariance += (member - out.mean) * (member - out.mean).transpose() / (count - 1);
  return out;
}

namespace {

/// True if a laboratory may be advised to take a reading; in studies of several tests its name follows a slash.
bool measurable(const std::string& name) {
  const std::string own = name.substr(name.find('/') + 1);
  const auto kinds = all_reading_kinds();
  const ReadingKind* kind = find_kind(kinds, own);
  return kind && kind->advised;
}

/// True if the model reproduces a reading; advice to repeat a reading that the model misses by far would mislead.
bool met(const ResponseModel& model, std::size_t reading, const UnitPoint& recommended) {
  const ReadingTrainingData& evidence = model.training_data().readings[reading];
  if (!evidence.measured) return true;
  const auto prediction = model.predict(reading, recommended);
  return std::abs(prediction.mean - *evidence.measured) <=
         3 * std::hypot(evidence.deviation, std::sqrt(prediction.variance));
}

/// Ratio of the standard deviations of each coordinate x after and before further measurements of one reading, by
/// linear regression in the sample: sqrt(1 - cov(x, m)^2/(var x (var m + error))), m: mean reading of a member of the
/// sample, error: variance of the mean of the new measurements plus predictive variance.
MeasurementGain gain_of(const ResponseModel& model, std::size_t reading, const std::vector<UnitPoint>& sample,
                        const Moments& moments, double typical_deviation) {
  const ReadingTrainingData& evidence = model.training_data().readings[reading];
  MeasurementGain gain;
  gain.reading = evidence.name;
  gain.deviation = evidence.measured ? evidence.deviation : typical_deviation;
  const auto count = static_cast<double>(sample.size());
  Eigen::VectorXd means(sample.size());
  double predictive_variance = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const auto prediction = model.predict(reading, sample[i]);
    means[i] = prediction.mean;
    predictive_variance += prediction.variance / count;
  }
  const Eigen::VectorXd deviations = means.array() - means.mean();
  const double error = gain.deviation * gain.deviation / gain.measurements + predictive_variance;
  const double variance = deviations.squaredNorm() / (count - 1);
  for (Eigen::Index j = 0; j < moments.mean.size(); ++j) {
    double covariance = 0;
    for (std::size_t i = 0; i < sample.size(); ++i)
      covariance += deviations[i] * (sample[i][j] - moments.mean[j]) / (count - 1);
    const double own = std::max(moments.covariance(j, j), 1e-12);
    const double left = std::sqrt(std::max(0.0, 1 - covariance * covariance / (own * (variance + error))));
    if (left >= gain.narrowing) continue;
    gain.narrowing = left;
    gain.parameter = model.training_data().parameters[j].name;
  }
  return gain;
}

}  // namespace

std::vector<MeasurementGain> measurement_gains(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                               const Moments& moments, const UnitPoint& recommended) {
  const std::vector<ReadingTrainingData>& readings = model.training_data().readings;
  double typical_deviation = std::numeric_limits<double>::infinity();
  for (const std::size_t k : model.fitted()) typical_deviation = std::min(typical_deviation, readings[k].deviation);
  std::vector<MeasurementGain> gains;
  for (std::size_t k = 0; k < readings.size(); ++k)
    if (measurable(readings[k].name) && met(model, k, recommended))
      gains.push_back(gain_of(model, k, sample, moments, typical_deviation));
  std::ranges::stable_sort(gains, {}, &MeasurementGain::narrowing);
  return gains;
}

}  // namespace pastefit
