#include "calibrate/evaluate/early_end.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/study/tolerance.h"

namespace pastefit {

namespace {

constexpr double level_in_tolerances = 8, level_in_deviations = 4;

}  // namespace

std::optional<Cutoff> cutoff_of(const Study& study, std::size_t test) {
  if (!study.search.end_early) return std::nullopt;
  const StudyTest& one = study.tests.at(test);
  const auto kinds = reading_kinds(one.lab.test);
  const auto ending = std::ranges::find(kinds, true, &ReadingKind::ends_early);
  if (ending == kinds.end()) return std::nullopt;
  std::optional<Cutoff> cutoff;
  bool later_stage = false;
  for (std::size_t k = 0; k < one.lab.measurements.size(); ++k) {
    const Measurement& measurement = one.lab.measurements[k];
    if (one.targets.at(k).weight == 0) continue;
    later_stage = later_stage || find_kind(kinds, measurement.reading)->stage > ending->stage;
    if (measurement.reading != ending->name) continue;
    const double level = std::max(level_in_tolerances * tolerance_of(study, test, k),
                                  level_in_deviations * measurement.standard_deviation);
    cutoff = Cutoff{measurement.reading, measurement.value - level, measurement.value + level};
  }
  if (cutoff && !later_stage) cutoff->highest = Cutoff{}.highest;
  return cutoff;
}

std::string key_of_ended(const std::string& whole_key, const Cutoff& cutoff) {
  return content_hash(nlohmann::json{whole_key, cutoff.reading, cutoff.lowest, cutoff.highest}.dump());
}

StoredEvaluation seen_through(const Test& test, const Cutoff& cutoff, StoredEvaluation evaluation) {
  if (evaluation.failure) return evaluation;
  const auto read = evaluation.readings.find(cutoff.reading);
  if (!read && !evaluation.run.ended_early) return evaluation;
  const bool below = !read || *read < cutoff.lowest;
  if (!below && !(*read > cutoff.highest)) return evaluation;
  const auto kinds = reading_kinds(test);
  const int last = find_kind(kinds, cutoff.reading)->stage - (below ? 1 : 0);
  Readings seen;
  for (const auto& [name, value] : evaluation.readings.all())
    if (const ReadingKind* kind = find_kind(kinds, name); kind && kind->stage <= last) seen.set(name, value);
  if (below) seen.set(cutoff.reading, cutoff.lowest);
  evaluation.readings = std::move(seen);
  evaluation.run.ended_early = true;
  return evaluation;
}

bool is_upper_bound(const Study& study, std::size_t test, std::string_view reading, double value) {
  const auto cutoff = cutoff_of(study, test);
  return cutoff && reading == cutoff->reading && value <= cutoff->lowest;
}

std::optional<StoredEvaluation> find(const Store& store, const Test& test, const std::string& whole_key,
                                     const std::optional<Cutoff>& cutoff) {
  if (!cutoff) return store.find(whole_key);
  auto evaluation = store.find(key_of_ended(whole_key, *cutoff));
  if (!evaluation) evaluation = store.find(whole_key);
  if (evaluation) evaluation = seen_through(test, *cutoff, std::move(*evaluation));
  return evaluation;
}

}  // namespace pastefit
