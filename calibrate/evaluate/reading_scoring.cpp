#include "calibrate/evaluate/reading_scoring.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pastefit {

ReadingScoring::ReadingScoring(std::vector<StudyReading> readings, const std::vector<Parameter>& parameters)
    : readings_(std::move(readings)) {
  for (const auto& parameter : parameters) {
    if (!parameter.free) continue;
    if (parameter.prior) known_.push_back({static_cast<Eigen::Index>(parameters_), unit_prior(parameter)});
    ++parameters_;
  }
  for (const auto& reading : readings_)
    if (!(reading.measurement.standard_deviation > 0 && reading.tolerance > 0))
      throw std::logic_error("standard deviation and tolerance of " + reading.name + " must be positive");
}

int ReadingScoring::residuals() const {
  return static_cast<int>(readings_.size() + known_.size());
}

double ReadingScoring::allowance(std::size_t reading) const {
  const StudyReading& fitted = readings_.at(reading);
  return std::sqrt(fitted.weight) * fitted.tolerance / fitted.measurement.standard_deviation;
}

double ReadingScoring::certain_miss(const Response& response, std::size_t reading) const {
  const StudyReading& fitted = readings_[reading];
  const double difference = response.readings[static_cast<Eigen::Index>(reading)] - fitted.measurement.value;
  if (std::isnan(difference)) return 0;
  const auto bounded = [&](const Evaluation& one) { return one.censored && is_bound(fitted, one.readings[reading]); };
  return std::ranges::any_of(response.evaluations, bounded) ? std::min(difference, 0.0) : difference;
}

Response ReadingScoring::response_of(std::vector<Evaluation> evaluations) const {
  const auto count = static_cast<Eigen::Index>(readings_.size());
  const auto packings = static_cast<double>(evaluations.size());
  Response out;
  out.readings = Eigen::VectorXd::Zero(count);
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
    out.rejected += evaluation.is_rejected() ? 1 : 0;
  }
  const auto judged = accepted(evaluations);
  for (const Evaluation* one : judged)
    for (Eigen::Index i = 0; i < count && !one->failure; ++i)
      out.readings[i] += one->readings[static_cast<std::size_t>(i)] / static_cast<double>(judged.size());
  if (!evaluations.empty()) out.point = evaluations.front().point;
  out.evaluations = std::move(evaluations);

  out.residuals = Eigen::VectorXd::Zero(residuals());
  for (std::size_t i = 0; i < known_.size(); ++i) {
    const auto& [coordinate, prior] = known_[i];
    out.residuals[count + static_cast<Eigen::Index>(i)] = (out.point[coordinate] - prior.mean) / prior.deviation;
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [test, name, measurement, weight, tolerance] = readings_[static_cast<std::size_t>(i)];
    if (out.failed)
      out.readings[i] = measurement.value + failure_factor * largest_error(readings_[static_cast<std::size_t>(i)]);
    double difference = out.readings[i] - measurement.value;
    if (out.censored && !out.failed) difference = certain_miss(out, static_cast<std::size_t>(i));
    out.residuals[i] = std::sqrt(weight) * difference / measurement.standard_deviation;
    if (weight == 0) continue;
    const double error = std::sqrt(squared_standard_error(out, static_cast<std::size_t>(i)));
    out.error = std::max(out.error, std::abs(difference) / tolerance);
    out.noise = std::max(out.noise, error / tolerance);
  }
  out.misfit = 0.5 * out.residuals.squaredNorm();
  return out;
}

}  // namespace pastefit
