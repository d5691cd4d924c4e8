#include "calibrate/search/early_end.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "calibrate/base/content_hash.h"
#include "calibrate/study/tolerance.h"
#include "core/rigs/slump/slump_readings.h"

namespace pastefit {

namespace {

constexpr double level_in_tolerances = 8, level_in_deviations = 4;

/// The reading on which a run may end.
const std::string height(std::ranges::find(reading_kinds(), true, &ReadingKind::ends_early)->name);

}  // namespace

std::optional<HeightWindow> window_of(const Study& study, std::size_t test) {
  if (!study.search.end_early) return std::nullopt;
  const StudyTest& one = study.tests.at(test);
  std::optional<HeightWindow> window;
  bool second_step = false;
  for (std::size_t k = 0; k < one.lab.measurements.size(); ++k) {
    const Measurement& measurement = one.lab.measurements[k];
    if (one.targets.at(k).weight == 0) continue;
    second_step = second_step || stage_of(measurement.observable) == Stage::step2;
    if (measurement.observable != height) continue;
    const double level = std::max(level_in_tolerances * tolerance_of(study, test, k),
                                  level_in_deviations * measurement.standard_deviation);
    window = HeightWindow{1e-3 * (measurement.value - level), 1e-3 * (measurement.value + level)};
  }
  if (window && !second_step) window->highest_m = HeightWindow{}.highest_m;
  return window;
}

std::string key_of_ended(const std::string& whole_key, const HeightWindow& window) {
  return content_hash(nlohmann::json{whole_key, window.lowest_m, window.highest_m}.dump());
}

StoredEvaluation seen_through(const HeightWindow& window, StoredEvaluation evaluation) {
  if (evaluation.failure) return evaluation;
  const auto read = evaluation.observables.find(height);
  if (!read && !evaluation.run.ended_early) return evaluation;
  const bool below = !read || 1e-3 * *read < window.lowest_m;
  if (!below && !(1e-3 * *read > window.highest_m)) return evaluation;
  Observables seen;
  for (const auto& [name, value] : evaluation.observables.all())
    if (stage_of(name) <= (below ? Stage::fill : Stage::step1)) seen.set(name, value);
  if (below) seen.set(height, 1e3 * window.lowest_m);
  evaluation.observables = std::move(seen);
  evaluation.run.ended_early = true;
  return evaluation;
}

bool is_upper_bound(const Study& study, std::size_t test, std::string_view observable, double value) {
  const auto window = window_of(study, test);
  return window && observable == height && value <= 1e3 * window->lowest_m;
}

std::optional<StoredEvaluation> find(const Store& store, const std::string& whole_key,
                                     const std::optional<HeightWindow>& window) {
  if (!window) return store.find(whole_key);
  auto evaluation = store.find(key_of_ended(whole_key, *window));
  if (!evaluation) evaluation = store.find(whole_key);
  if (evaluation) evaluation = seen_through(*window, std::move(*evaluation));
  return evaluation;
}

}  // namespace pastefit
