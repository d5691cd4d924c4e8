#include "calibrate/evaluate/study_scoring.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/evaluate/response.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

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

double ReadingScoring::largest_error(const StudyReading& reading) const {
  return std::max(std::abs(reading.measurement.value), 10 * reading.measurement.standard_deviation);
}

double ReadingScoring::certain_miss(const Response& response, std::size_t reading) const {
  const StudyReading& fitted = readings_[reading];
  const double difference = response.readings[reading] - fitted.measurement.value;
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
      out.readings[i] += one->readings[i] / static_cast<double>(judged.size());
  if (!evaluations.empty()) out.point = evaluations.front().point;
  out.evaluations = std::move(evaluations);

  out.residuals = Eigen::VectorXd::Zero(residuals());
  for (std::size_t i = 0; i < known_.size(); ++i) {
    const auto& [coordinate, prior] = known_[i];
    out.residuals[count + static_cast<Eigen::Index>(i)] = (out.point[coordinate] - prior.mean) / prior.deviation;
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [test, name, measurement, weight, tolerance] = readings_[i];
    if (out.failed) out.readings[i] = measurement.value + failure_factor * largest_error(readings_[i]);
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

namespace {

std::optional<LikelyRange> strength_by_readings(const StudyTest& test) {
  Readings measured;
  for (const Measurement& one : test.lab.measurements) measured.set(one.reading, one.value);
  return std::visit([&](const auto& one) { return likely_strength_pa(one, measured); }, test.lab.test);
}

/// Largest possible error of a heap, in the reading's unit.
double worst_miss(const Study& study, const StudyReading& reading) {
  const Measurement& measurement = reading.measurement;
  const auto kinds = reading_kinds(study.tests.at(reading.test).lab.test);
  const ReadingKind* kind = find_kind(kinds, measurement.reading);
  const double bound = kind && kind->worst_miss ? *kind->worst_miss : 10 * measurement.standard_deviation;
  return std::max(std::abs(measurement.value), bound);
}

}  // namespace

StudyScoring::StudyScoring(const Study& study)
    : ReadingScoring(readings_of(study), study.parameters), study_(study), fitted_(tests_of(study, false)) {
  if (fitted_.empty()) throw std::logic_error("a study needs a test that is fitted");
}

double StudyScoring::largest_error(const StudyReading& reading) const {
  return worst_miss(study_, reading);
}

bool StudyScoring::is_bound(const StudyReading& reading, double value) const {
  return is_upper_bound(study_, reading.test, reading.measurement.reading, value);
}

UnitBox StudyScoring::likely_box() const {
  UnitBox box = ReadingScoring::likely_box();
  Eigen::Index coordinate = 0;
  for (const Parameter& parameter : study_.parameters) {
    if (!parameter.free) continue;
    double lower = 0, upper = 1;
    for (const std::size_t test : fitted_) {
      const auto likely = parameter.name == "strength_pa" ? strength_by_readings(study_.tests[test]) : std::nullopt;
      if (!likely) continue;
      if (likely->lowest > parameter.lower) lower = std::max(lower, unit_of(parameter, likely->lowest));
      upper = std::min(upper, unit_of(parameter, likely->highest));
    }
    if (lower < upper) {
      box.lower[coordinate] = lower;
      box.upper[coordinate] = upper;
    }
    ++coordinate;
  }
  return box;
}

Evaluation StudyScoring::evaluation_of(const UnitPoint& point, const StoredEvaluation& stored) const {
  Evaluation out;
  out.point = point;
  out.packing = stored.packing;
  out.failure = stored.failure;
  out.censored = !out.failure && stored.run.ended_early;
  out.rejection_index = rejection_index(study_, fitted_, stored);
  if (!out.failure)
    for (const auto& reading : scored())
      out.readings.push_back(out.censored ? stored.readings.find(reading.name).value_or(std::nan(""))
                                          : stored.readings.find(reading.name).value());
  return out;
}

namespace {

constexpr double worst_factor = 3;  // largest factor on the largest error of a failed candidate (`ReadingScoring`)

bool has_finite_square(double residual) {
  return std::isfinite(residual * residual);
}

bool is_positive(double number) {
  return number > 0 && std::isfinite(number);
}

}  // namespace

Faults validate_residuals(const Study& study) {
  Faults faults;
  for (const Parameter& parameter : study.parameters) {
    if (!parameter.free || !parameter.prior) continue;
    const UnitPrior prior = unit_prior(parameter);
    const bool good = is_positive(prior.deviation) && has_finite_square(prior.mean / prior.deviation) &&
                      has_finite_square((1 - prior.mean) / prior.deviation);
    if (!good)
      faults.push_back({"parameters." + parameter.name + ".prior.standard_deviation",
                        shown(parameter.prior->standard_deviation) + " makes residuals that are not finite",
                        "a larger one, or a fixed value"});
  }
  for (const StudyReading& reading : readings_of(study)) {
    const auto& [test, name, measurement, weight, tolerance] = reading;
    const double difference = worst_factor * worst_miss(study, reading);
    const auto refuse = [&, &place = reading.name](bool good, const char* what, double value) {
      if (!good)
        faults.push_back({place, std::string(what) + " " + shown(value) + " makes residuals that are not finite",
                          "a number above 0, of the size of the reading"});
    };
    const double deviation = measurement.standard_deviation;
    refuse(is_positive(deviation) && has_finite_square(std::sqrt(weight) * difference / deviation),
           "standard deviation", deviation);
    refuse(is_positive(tolerance) && has_finite_square(difference / tolerance), "tolerance", tolerance);
  }
  return faults;
}

}  // namespace pastefit
