#include "calibrate/evaluate/task.h"

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
  const Outcome outcome = simulate(test, options);
  return nlohmann::ordered_json{
      {"readings", to_json(outcome.readings)}, {"run", to_json(outcome.run, 0)}, {"failure", to_json(outcome.failure)}}
      .dump();
}

std::string failed_task(const std::string& message) {
  Failure failure;
  failure.reason = FailureReason::engine_failed;
  failure.message = message;
  return nlohmann::ordered_json{{"failure", to_json(std::optional(failure))}}.dump();
}

Outcome outcome_of_task(const std::string& answer) {
  Outcome outcome;
  if (answer.empty()) {
    outcome.failure.emplace().reason = FailureReason::stopped;
    return outcome;
  }
  const auto given = nlohmann::ordered_json::parse(answer);
  outcome.failure = failure_from_json(given.at("failure"));
  if (given.contains("readings")) outcome.readings = readings_from_json(given.at("readings"));
  if (given.contains("run")) outcome.run = run_from_json(given.at("run"));
  return outcome;
}

}  // namespace pastefit
