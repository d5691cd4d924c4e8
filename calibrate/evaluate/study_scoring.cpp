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

namespace {

std::optional<LikelyRange> strength_by_readings(const StudyTest& test) {
  Readings measured;
  for (const Measurement& one : test.lab.measurements) measured.set(one.reading, one.value);
  return likely_strength_pa(test.lab.test, measured);
}

}  // namespace

StudyScoring::StudyScoring(const Study& study)
    : ReadingScoring(readings_of(study), study.parameters), study_(study), fitted_(tests_of(study, false)) {
  if (fitted_.empty()) throw std::logic_error("a study needs a test that is fitted");
}

double StudyScoring::largest_error(const StudyReading& reading) const {
  return worst_miss(study_, reading.test, reading.measurement);
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

bool has_finite_square(double residual) {
  return std::isfinite(residual * residual);
}

bool is_positive(double number) {
  return number > 0 && std::isfinite(number);
}

}  // namespace

double worst_miss(const Study& study, std::size_t test, const Measurement& measurement) {
  const auto kinds = reading_kinds(study.tests.at(test).lab.test);
  const ReadingKind* kind = find_kind(kinds, measurement.reading);
  const double bound = kind && kind->worst_miss ? *kind->worst_miss : 10 * measurement.standard_deviation;
  return std::max(std::abs(measurement.value), bound);
}

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
    const double difference = worst_factor * worst_miss(study, test, measurement);
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
