#include "calibrate/inference/measurement_gain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/laboratory/test.h"

namespace pastefit {

namespace {

/// A reading a laboratory may be advised to take, by the name of the simulation's reading; with the name of its test
/// before a slash where a study has several.
bool measurable(const std::string& name) {
  const std::string own = name.substr(name.find('/') + 1);
  const auto kinds = all_reading_kinds();
  const ReadingKind* kind = find_kind(kinds, own);
  return kind && kind->advised;
}

/// Whether the model meets a reading; repeating one that it misses by far would only mislead.
bool met(const ResponseModel& model, std::size_t reading, const UnitPoint& recommended) {
  const ReadingTrainingData& evidence = model.training_data().readings[reading];
  if (!evidence.measured) return true;
  const auto prediction = model.predict(reading, recommended);
  return std::abs(prediction.mean - *evidence.measured) <=
         3 * std::hypot(evidence.deviation, std::sqrt(prediction.variance));
}

/// Standard deviation of each coordinate x after further measurements of one reading over that before, by linear
/// regression in the sample: sqrt(1 - cov(x, m)^2/(var x (var m + error))), m the mean reading of a member of the
/// sample, error the variance of the mean of the new measurements and the predictive variance.
MeasurementGain gain_of(const ResponseModel& model, std::size_t reading, const std::vector<UnitPoint>& sample,
                        const Moments& moments, std::size_t lead, int repeats, double typical_deviation) {
  const ReadingTrainingData& evidence = model.training_data().readings[reading];
  MeasurementGain gain;
  gain.reading = evidence.name;
  gain.measurements = repeats;
  gain.deviation = evidence.measured ? evidence.deviation : typical_deviation;
  const auto count = static_cast<double>(sample.size());
  Eigen::VectorXd means(static_cast<Eigen::Index>(sample.size()));
  double predictive_variance = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const auto prediction = model.predict(reading, sample[i]);
    means[static_cast<Eigen::Index>(i)] = prediction.mean;
    predictive_variance += prediction.variance / count;
  }
  const Eigen::VectorXd deviations = means.array() - means.mean();
  const double error = gain.deviation * gain.deviation / repeats + predictive_variance;
  const double variance = deviations.squaredNorm() / (count - 1);
  for (Eigen::Index j = 0; j < moments.mean.size(); ++j) {
    double covariance = 0;
    for (std::size_t i = 0; i < sample.size(); ++i)
      covariance += deviations[static_cast<Eigen::Index>(i)] * (sample[i][j] - moments.mean[j]) / (count - 1);
    const double own = std::max(moments.covariance(j, j), 1e-12);
    const double left = std::sqrt(std::max(0.0, 1 - covariance * covariance / (own * (variance + error))));
    if (static_cast<std::size_t>(j) == lead) gain.lead_narrowing = left;
    if (left >= gain.narrowing) continue;
    gain.narrowing = left;
    gain.parameter = model.training_data().parameters[static_cast<std::size_t>(j)].name;
  }
  return gain;
}

}  // namespace

std::vector<MeasurementGain> measurement_gains(const ResponseModel& model, const std::vector<UnitPoint>& sample,
                                               const Moments& moments, const UnitPoint& recommended, std::size_t lead,
                                               int repeats) {
  const std::vector<ReadingTrainingData>& readings = model.training_data().readings;
  double typical_deviation = std::numeric_limits<double>::infinity();
  for (const std::size_t k : model.fitted()) typical_deviation = std::min(typical_deviation, readings[k].deviation);
  std::vector<MeasurementGain> gains;
  for (std::size_t k = 0; k < readings.size(); ++k)
    if (measurable(readings[k].name) && met(model, k, recommended))
      gains.push_back(gain_of(model, k, sample, moments, lead, repeats, typical_deviation));
  std::ranges::stable_sort(gains, {}, &MeasurementGain::narrowing);
  return gains;
}

}  // namespace pastefit
