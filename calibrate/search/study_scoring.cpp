#include "calibrate/search/study_scoring.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "calibrate/search/early_end.h"
#include "calibrate/search/record.h"
#include "calibrate/search/residual_size.h"
#include "calibrate/search/response.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

std::optional<LikelyRange> strength_by_readings(const StudyTest& test) {
  Observables measured;
  for (const Measurement& one : test.lab.measurements) measured.set(one.observable, one.value);
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
  return is_upper_bound(study_, reading.test, reading.measurement.observable, value);
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
      out.observables.push_back(out.censored ? stored.observables.find(reading.name).value_or(std::nan(""))
                                             : stored.observables.find(reading.name).value());
  return out;
}

}  // namespace pastefit
