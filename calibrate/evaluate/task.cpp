#include "calibrate/evaluate/task.h"

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "calibrate/base/refusal.h"
#include "calibrate/store/outcome_json.h"

namespace pastefit {

using nlohmann::json;

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
