#include "calibrate/inference/evidence.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calibrate/base/statistics.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

constexpr double least_survival = 1e-3;  // a model of failures is too rough to rule a candidate out

/// Sum of squares, each in standard deviations of the prior.
double distance_from_priors(const Evidence& evidence, const UnitPoint& point) {
  double squares = 0;
  for (std::size_t j = 0; j < evidence.parameters.size(); ++j) {
    if (!evidence.parameters[j].prior) continue;
    const UnitPrior prior = unit_prior(evidence.parameters[j]);
    squares += std::pow((point[static_cast<Eigen::Index>(j)] - prior.mean) / prior.deviation, 2);
  }
  return squares;
}

}  // namespace

Evidence evidence_of(const Study& study, std::span<const StoredEvaluation> evaluations) {
  Evidence evidence;
  for (const Parameter& parameter : study.parameters)
    if (parameter.free) evidence.parameters.push_back(parameter);
  std::vector<const StoredEvaluation*> good;
  for (const StoredEvaluation& evaluation : evaluations) {
    const auto count = static_cast<Eigen::Index>(evaluation.point.size());
    const UnitPoint point = Eigen::Map<const Eigen::VectorXd>(evaluation.point.data(), count);
    (evaluation.failure ? evidence.failed : evidence.points).push_back(point);
    if (!evaluation.failure) good.push_back(&evaluation);
  }
  if (good.empty()) return evidence;
  const std::vector<StudyReading> fitted = readings_of(study);
  const auto readings = [](const StoredEvaluation* one) { return one->observables.all().size(); };
  for (const Observable& reading : (*std::ranges::max_element(good, {}, readings))->observables.all()) {
    ReadingEvidence one;
    one.name = reading.name;
    one.simulated.resize(static_cast<Eigen::Index>(good.size()));
    for (std::size_t i = 0; i < good.size(); ++i)
      one.simulated[static_cast<Eigen::Index>(i)] = good[i]->observables.find(reading.name).value_or(std::nan(""));
    if ((one.simulated.array().isInf()).any()) continue;
    if (const auto known = std::ranges::find(fitted, reading.name, &StudyReading::name); known != fitted.end()) {
      one.measured = known->measurement.value;
      one.deviation = known->measurement.standard_deviation;
      one.repeats = known->measurement.repeats;
      one.widening = widening(one.repeats);
      one.weight = known->weight;
    }
    evidence.readings.push_back(std::move(one));
  }
  return evidence;
}

ResponseModel::ResponseModel(Evidence evidence) : evidence_(std::move(evidence)) {
  if (evidence_.points.empty()) throw std::logic_error("a response model needs a simulation that ended well");
  for (const ReadingEvidence& reading : evidence_.readings) {
    std::vector<UnitPoint> points;
    std::vector<double> values;
    for (std::size_t i = 0; i < evidence_.points.size(); ++i) {
      const double value = reading.simulated[static_cast<Eigen::Index>(i)];
      if (std::isnan(value)) continue;
      points.push_back(evidence_.points[i]);
      values.push_back(value);
    }
    models_.emplace_back(points, Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)));
  }
  if (evidence_.failed.empty()) return;
  std::vector<UnitPoint> all = evidence_.points;
  all.insert(all.end(), evidence_.failed.begin(), evidence_.failed.end());
  Eigen::VectorXd share = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(all.size()));
  share.tail(static_cast<Eigen::Index>(evidence_.failed.size())).setOnes();
  failures_.emplace(all, share);
}

GaussianProcess::Prediction ResponseModel::predict(std::size_t reading, const UnitPoint& point) const {
  return models_.at(reading).predict(point);
}

double ResponseModel::noise(std::size_t reading) const {
  return std::sqrt(models_.at(reading).noise_variance());
}

double ResponseModel::miss(const UnitPoint& point) const {
  double squares = 0;
  for (std::size_t k = 0; k < models_.size(); ++k) {
    const ReadingEvidence& reading = evidence_.readings[k];
    if (!reading.fitted()) continue;
    squares += reading.weight * std::pow((models_[k].predict(point).mean - *reading.measured) / reading.deviation, 2);
  }
  return std::sqrt(squares + distance_from_priors(evidence_, point));
}

double ResponseModel::log_posterior(const UnitPoint& point) const {
  return log_likelihood(point) - 0.5 * distance_from_priors(evidence_, point);
}

double ResponseModel::log_likelihood(const UnitPoint& point) const {
  double sum = 0;
  for (std::size_t k = 0; k < models_.size(); ++k) {
    const ReadingEvidence& reading = evidence_.readings[k];
    if (!reading.fitted()) continue;
    const auto prediction = models_[k].predict(point);
    const double variance = reading.variance() + prediction.variance;
    sum -= 0.5 * (std::pow(prediction.mean - *reading.measured, 2) / variance + std::log(variance));
  }
  if (failures_) sum += std::log(std::clamp(1 - failures_->predict(point).mean, least_survival, 1.0));
  return sum;
}

}  // namespace pastefit
