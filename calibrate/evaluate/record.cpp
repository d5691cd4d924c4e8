#include "calibrate/evaluate/record.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <set>
#include <unordered_set>
#include <utility>

#include "calibrate/evaluate/simulation.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

constexpr double rounding = 1e-12;  // of a coordinate that was converted to a value and back

/// Merged evaluation of a candidate on one packing, if stored. `before`: only from epochs before this one. `tried`: as
/// a simulation that may end early (`Simulation`) shows it.
std::optional<StoredEvaluation> find_in(const Study& study, std::span<const std::size_t> tests, const Store& store,
                                        std::span<const double> values, std::uint64_t packing, int before, bool tried) {
  std::vector<StoredEvaluation> found;
  for (const std::size_t test : tests) {
    const auto cutoff = tried ? cutoff_of(study, test) : std::nullopt;
    auto evaluation =
        find(store, study.tests[test].lab.test, key_of(study, test, values, packing, store.identity().program), cutoff);
    if (!evaluation || evaluation->epoch >= before) return std::nullopt;
    found.push_back(std::move(*evaluation));
  }
  return merged(study, tests, found);
}

/// Point of these values in the unit cube; none if a fixed value differs or a free one is outside its bounds.
std::optional<std::vector<double>> point_at(const Study& study, std::span<const double> values) {
  if (values.size() != study.parameters.size()) return std::nullopt;
  std::vector<double> point;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Parameter& parameter = study.parameters[i];
    if (!parameter.free && parameter.value != values[i]) return std::nullopt;
    if (!parameter.free) continue;
    const double unit = unit_of(parameter, values[i]);
    if (!(unit >= -rounding && unit <= 1 + rounding)) return std::nullopt;
    point.push_back(std::clamp(unit, 0.0, 1.0));
  }
  return point;
}

/// Candidates of epochs before this one that are valid for the study, each with each packing once, sorted by values and
/// packing. `ways`: accepted forms (`tried`), the preferred one first.
std::vector<StoredEvaluation> held(const Study& study, const Store& store, int before,
                                   std::initializer_list<bool> ways) {
  std::vector<StoredEvaluation> out;
  const auto tests = tests_of(study, false);
  std::set<std::pair<std::vector<double>, std::uint64_t>> known;
  for (const StoredEvaluation& evaluation : store.all()) {
    if (evaluation.epoch >= before) continue;
    const auto point = point_at(study, evaluation.values);
    if (!point) continue;
    std::optional<StoredEvaluation> found;
    for (const bool tried : ways)
      if (!found) found = find_in(study, tests, store, evaluation.values, evaluation.packing, before, tried);
    if (!found || !known.emplace(found->values, found->packing).second) continue;
    found->point = *point;
    out.push_back(std::move(*found));
  }
  // The order of arrival depends on the machine.
  std::ranges::sort(out, [](const StoredEvaluation& a, const StoredEvaluation& b) {
    return a.values != b.values ? a.values < b.values : a.packing < b.packing;
  });
  return out;
}

}  // namespace

std::string key_of(const Study& study, std::size_t test, std::span<const double> values, std::uint64_t packing,
                   std::string_view program) {
  return evaluation_key(program, test_with(study.tests.at(test).lab.test, values, packing));
}

std::optional<Failure> failure_of(const StudyTest& test, const StoredEvaluation& evaluation) {
  if (evaluation.failure) return evaluation.failure;
  for (const Measurement& measurement : test.lab.measurements) {
    const auto value = evaluation.readings.find(measurement.reading);
    if (value ? std::isfinite(*value) : evaluation.run.ended_early) continue;
    Failure failure;
    failure.reason = FailureReason::non_finite;
    failure.phase = "reading";
    failure.step = evaluation.run.steps;
    failure.time_s = evaluation.run.simulated_s;
    failure.value = value.value_or(std::numeric_limits<double>::quiet_NaN());
    failure.message =
        "The run gave no reading of " + reading_name(test, measurement.reading) + "; look at its heap with --vtk.";
    return failure;
  }
  return std::nullopt;
}

StoredEvaluation merged(const Study& study, std::span<const std::size_t> tests,
                        std::span<const StoredEvaluation> evaluations) {
  StoredEvaluation out = evaluations.front();
  out.readings = {};
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    const StudyTest& test = study.tests.at(tests[i]);
    if (!out.failure) out.failure = failure_of(test, evaluations[i]);
    out.run.ended_early = out.run.ended_early || evaluations[i].run.ended_early;
    for (const auto& [name, value] : evaluations[i].readings.all()) out.readings.set(reading_name(test, name), value);
  }
  if (out.failure) out.readings = {};
  return out;
}

double rejection_index(const Study& study, std::span<const std::size_t> tests, const StoredEvaluation& merged) {
  double highest = std::nan("");
  if (merged.failure) return highest;
  for (const std::size_t index : tests) {
    const StudyTest& test = study.tests[index];
    Readings run;
    for (const ReadingKind& kind : reading_kinds(test.lab.test))
      if (const auto value = merged.readings.find(reading_name(test, kind.name))) run.set(kind.name, *value);
    highest = std::fmax(highest, rejection_index(test.lab.test, run).value_or(std::nan("")));
  }
  return highest;
}

double rejected_share_of(const Study& study) {
  const auto fitted = tests_of(study, false);
  const auto may_be = [&](std::size_t test) { return rejection_index(study.tests[test].lab.test, {}).has_value(); };
  return std::ranges::any_of(fitted, may_be) ? study.search.rejected_share : 1;
}

std::vector<Readings> known_runs(const Study& study, std::size_t test, const UnitPoint& point,
                                 std::span<const std::uint64_t> packings, const Store& store) {
  const std::vector<double> values = values_at(study, coordinates(point));
  std::vector<Readings> runs;
  for (const std::uint64_t packing : packings) {
    auto found = store.find(key_of(study, test, values, packing, store.identity().program));
    if (!found || failure_of(study.tests[test], *found)) return {};
    runs.push_back(std::move(found->readings));
  }
  return runs;
}

namespace {

/// True if an evaluation is of one of the study's tests, for any candidate.
bool holds_any(const Store& store, const Study& study) {
  return std::ranges::any_of(store.all(), [&](const StoredEvaluation& one) {
    for (std::size_t test = 0; test < study.tests.size(); ++test) {
      const std::string key = key_of(study, test, one.values, one.packing, store.identity().program);
      const auto cutoff = cutoff_of(study, test);
      if (key == one.key || (cutoff && key_of_ended(key, *cutoff) == one.key)) return true;
    }
    return false;
  });
}

}  // namespace

Faults strangers_in(const Study& study, const Store& store, const std::string& file) {
  if (store.size() == 0 || holds_any(store, study)) return {};
  // A search that was stopped early may have used coarse grains only.
  if (study.search.coarse_first && holds_any(store, with_coarse_grains(study))) return {};
  return {{file,
           "none of its " + std::to_string(store.size()) +
               " evaluations is of a test of this study; changed: " + listed(store.changes()),
           "resume with the apparatus, the grains and the density as they were; or choose another output folder, or "
           "start anew with --force"}};
}

std::vector<StoredEvaluation> earlier_of(const Study& study, const Store& store) {
  return held(study, store, store.epoch(), {true});
}

std::vector<StoredEvaluation> everything_of(const Study& study, const Store& store) {
  return held(study, store, std::numeric_limits<int>::max(), {false, true});
}

std::vector<StoredEvaluation> record_of(const Study& study, const Store& store, std::span<const Response> history) {
  std::vector<StoredEvaluation> record = earlier_of(study, store);
  const auto tests = tests_of(study, false);
  std::unordered_set<std::string> known;
  for (const StoredEvaluation& evaluation : record) known.insert(evaluation.key);
  for (const Response& response : history) {
    const std::vector<double> values = values_at(study, coordinates(response.point));
    for (const Evaluation& one : response.evaluations) {
      auto found = find_in(study, tests, store, values, one.packing, std::numeric_limits<int>::max(), one.censored);
      if (!found || !known.insert(found->key).second) continue;
      found->point.assign(response.point.begin(), response.point.end());
      record.push_back(std::move(*found));
    }
  }
  return record;
}

}  // namespace pastefit
