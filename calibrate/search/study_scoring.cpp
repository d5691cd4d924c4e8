#include "calibrate/search/study_scoring.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "calibrate/search/early_end.h"
#include "calibrate/search/record.h"
#include "calibrate/search/residual_size.h"
#include "calibrate/search/response.h"
#include "calibrate/study/tests.h"

namespace pastefit {

StudyScoring::StudyScoring(const Study& study)
    : study_(study), readings_(readings_of(study)), fitted_(tests_of(study, false)) {
  Eigen::Index coordinate = 0;
  for (const auto& parameter : study.parameters) {
    if (!parameter.free) continue;
    if (parameter.prior) known_.push_back({coordinate, unit_prior(parameter)});
    ++coordinate;
  }
  if (fitted_.empty()) throw std::logic_error("a study needs a test that is fitted");
  for (const auto& reading : readings_)
    if (!(reading.measurement.standard_deviation > 0 && reading.tolerance > 0))
      throw std::logic_error("standard deviation and tolerance of " + reading.name + " must be positive");
}

int StudyScoring::parameters() const {
  return free_count(study_);
}

int StudyScoring::residuals() const {
  return static_cast<int>(readings_.size() + known_.size());
}

Evaluation StudyScoring::evaluation_of(const UnitPoint& point, const StoredEvaluation& stored) const {
  Evaluation out;
  out.point = point;
  out.packing = stored.packing;
  out.failure = stored.failure;
  out.censored = !out.failure && stored.run.ended_early;
  out.rejected = is_rejected(study_, fitted_, stored);
  if (!out.failure)
    for (const auto& reading : readings_)
      out.observables.push_back(out.censored ? stored.observables.find(reading.name).value_or(std::nan(""))
                                             : stored.observables.find(reading.name).value());
  return out;
}

double StudyScoring::allowance(std::size_t reading) const {
  const StudyReading& fitted = readings_.at(reading);
  return std::sqrt(fitted.weight) * fitted.tolerance / fitted.measurement.standard_deviation;
}

double StudyScoring::certain_miss(const Response& response, std::size_t reading) const {
  const StudyReading& fitted = readings_[reading];
  const double difference = response.observables[static_cast<Eigen::Index>(reading)] - fitted.measurement.value;
  if (std::isnan(difference)) return 0;
  const auto is_bound = [&](const Evaluation& one) {
    return one.censored && is_upper_bound(study_, fitted.test, fitted.measurement.observable, one.observables[reading]);
  };
  return std::ranges::any_of(response.evaluations, is_bound) ? std::min(difference, 0.0) : difference;
}

Response StudyScoring::response_of(std::vector<Evaluation> evaluations) const {
  const auto count = static_cast<Eigen::Index>(readings_.size());
  const auto packings = static_cast<double>(evaluations.size());
  Response out;
  out.observables = Eigen::VectorXd::Zero(count);
  double failure_factor = 2;
  for (const auto& evaluation : evaluations) {
    out.packings.push_back(evaluation.packing);
    if (evaluation.failure) {
      out.failed = true;
      const double time = evaluation.failure->time_s;
      failure_factor += 1 / (1 + (std::isfinite(time) ? std::max(0.0, time) : 0.0)) / packings;
      continue;
    }
    out.censored = out.censored || evaluation.censored;
    out.rejected += evaluation.rejected ? 1 : 0;
  }
  const auto judged = accepted(evaluations);
  for (const Evaluation* one : judged)
    for (Eigen::Index i = 0; i < count && !one->failure; ++i)
      out.observables[i] += one->observables[static_cast<std::size_t>(i)] / static_cast<double>(judged.size());
  if (!evaluations.empty()) out.point = evaluations.front().point;
  out.evaluations = std::move(evaluations);

  out.residuals = Eigen::VectorXd::Zero(residuals());
  for (std::size_t i = 0; i < known_.size(); ++i) {
    const auto& [coordinate, prior] = known_[i];
    out.residuals[count + static_cast<Eigen::Index>(i)] = (out.point[coordinate] - prior.mean) / prior.deviation;
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [test, name, measurement, weight, tolerance] = readings_[static_cast<std::size_t>(i)];
    if (out.failed) out.observables[i] = measurement.value + failure_factor * worst_miss(study_, test, measurement);
    double difference = out.observables[i] - measurement.value;
    if (out.censored && !out.failed) difference = certain_miss(out, static_cast<std::size_t>(i));
    out.residuals[i] = std::sqrt(weight) * difference / measurement.standard_deviation;
    if (weight == 0) continue;
    const double error = std::sqrt(squared_standard_error(out, static_cast<std::size_t>(i)));
    out.normalised_error = std::max(out.normalised_error, std::abs(difference) / tolerance);
    out.noise = std::max(out.noise, error / tolerance);
  }
  out.misfit = 0.5 * out.residuals.squaredNorm();
  return out;
}

}  // namespace pastefit
