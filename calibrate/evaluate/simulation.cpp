#include "calibrate/evaluate/simulation.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "calibrate/base/refusal.h"
#include "calibrate/base/text.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

using nlohmann::json;

namespace {

const Test& bare_test(const Simulation& simulation) {
  return simulation.study->tests.at(simulation.test).lab.test;
}

}  // namespace

Test test_of(const Simulation& simulation) {
  return test_with(bare_test(simulation), values_at(*simulation.study, coordinates(simulation.point)),
                   simulation.packing);
}

std::optional<Cutoff> cutoff_of(const Simulation& simulation) {
  return simulation.may_end_early ? cutoff_of(*simulation.study, simulation.test) : std::nullopt;
}

StoredEvaluation unanswered(const Simulation& simulation, std::string_view program) {
  const UnitPoint& point = simulation.point;
  if (point.size() != free_count(*simulation.study) || !point.allFinite() || point.minCoeff() < 0 ||
      point.maxCoeff() > 1)
    throw std::logic_error("a candidate must lie in the unit cube over the free parameters");
  StoredEvaluation out;
  out.values = values_at(*simulation.study, coordinates(point));
  out.key = key_of(*simulation.study, simulation.test, out.values, simulation.packing, program);
  out.point.assign(point.begin(), point.end());
  out.packing = simulation.packing;
  return out;
}

void enter(StoredEvaluation& evaluation, Outcome outcome, const std::optional<Cutoff>& cutoff) {
  evaluation.failure = std::move(outcome.failure);
  if (!evaluation.failure) evaluation.readings = std::move(outcome.readings);
  evaluation.run = outcome.run;
  if (outcome.run.ended_early) evaluation.key = key_of_ended(evaluation.key, cutoff.value());
}

std::optional<StoredEvaluation> find(const Store& store, const Simulation& simulation) {
  return find(store, bare_test(simulation), unanswered(simulation, store.identity().program).key,
              cutoff_of(simulation));
}

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
  return content_hash(json{whole_key, cutoff.reading, cutoff.lowest, cutoff.highest}.dump());
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

namespace {

/// Packings of this process's latest tasks, each filled once.
class Packings {
 public:
  std::shared_ptr<const Packing> of(const std::string& name, const Test& test) {
    constexpr std::size_t kMost = 64;
    std::shared_ptr<Filled> one;
    {
      const std::lock_guard lock(mutex_);
      if (filled_.size() >= kMost && !filled_.contains(name)) filled_.clear();
      std::shared_ptr<Filled>& entry = filled_[name];
      if (!entry) entry = std::make_shared<Filled>();
      one = entry;
    }
    std::call_once(one->once, [&] { one->packing = prepare(test); });
    return one->packing;
  }

 private:
  struct Filled {
    std::once_flag once;
    std::shared_ptr<const Packing> packing;
  };
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Filled>> filled_;
};

constexpr double kSketchInterval = 0.002;  // simulated seconds between two looks

}  // namespace

std::string task_text(const Test& test, const RunOptions& options, const std::string& packing) {
  json task{{"test", to_json(test)}, {"energy_balance", options.steps.energy_balance}, {"packing", packing}};
  if (options.cutoff)
    task["cutoff"] = {{"reading", options.cutoff->reading},
                      {"lowest", number_to_json(options.cutoff->lowest)},
                      {"highest", number_to_json(options.cutoff->highest)}};
  return task.dump();
}

std::string simulate_task(const std::string& text) {
  static Packings packings;
  const json task = json::parse(text);
  const Test test = value_or_throw(test_from_json(task.at("test")));
  RunOptions options;
  options.steps.energy_balance = task.at("energy_balance").get<bool>();
  if (const auto cutoff = task.find("cutoff"); cutoff != task.end())
    options.cutoff = {cutoff->at("reading").get<std::string>(), number_from_json(cutoff->at("lowest")),
                      number_from_json(cutoff->at("highest"))};
  options.packing = packings.of(task.at("packing").get<std::string>(), test);
  Sketcher sketcher;
  options.watch_interval_s = kSketchInterval;
  options.watch = [&](const Snapshot& snapshot) {
    sketcher.see(test, snapshot);
    return true;
  };
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = simulate(test, options);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  nlohmann::ordered_json answer{{"readings", to_json(outcome.readings)},
                                {"run", to_json(outcome.run, wall.count())},
                                {"failure", to_json(outcome.failure)}};
  if (const Sketch sketch = sketcher.sketch(outcome); !sketch.points.empty()) answer["sketch"] = to_json(sketch);
  return answer.dump();
}

std::string failed_task(const std::string& message) {
  Failure failure;
  failure.reason = FailureReason::engine_failed;
  failure.message = message;
  return nlohmann::ordered_json{{"failure", to_json(std::optional(failure))}}.dump();
}

TaskAnswer answer_of_task(const std::string& text) {
  TaskAnswer answer;
  Outcome& outcome = answer.outcome;
  if (text.empty()) {
    outcome.failure.emplace().reason = FailureReason::stopped;
    return answer;
  }
  const auto given = nlohmann::ordered_json::parse(text);
  outcome.failure = failure_from_json(given.at("failure"));
  if (given.contains("readings")) outcome.readings = readings_from_json(given.at("readings"));
  if (given.contains("run")) {
    outcome.run = run_from_json(given.at("run"));
    answer.wall_s = number_from_json(given.at("run").at("wall_s"));
  }
  if (given.contains("sketch")) answer.sketch = sketch_from_json(given.at("sketch"));
  return answer;
}

}  // namespace pastefit
