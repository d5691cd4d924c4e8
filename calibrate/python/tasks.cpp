#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "calibrate/python/module.h"
#include "calibrate/store/outcome_json.h"
#include "core/apparatus/slump/packing.h"

namespace pastefit::python {

namespace py = pybind11;
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

std::string simulate_task(const std::string& text) {
  static Packings packings;
  const json task = parsed(text);
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

json task_json(const Test& test, const RunOptions& options, const std::string& packing) {
  json task{{"test", to_json(test)}, {"energy_balance", options.steps.energy_balance}, {"packing", packing}};
  if (options.cutoff)
    task["cutoff"] = {{"reading", options.cutoff->reading},
                      {"lowest", number_to_json(options.cutoff->lowest)},
                      {"highest", number_to_json(options.cutoff->highest)}};
  return task;
}

/// Names of packings that are filled by the process that needs them.
class PackingNames {
 public:
  explicit PackingNames(std::string engine) : engine_(std::move(engine)) {}

  std::shared_ptr<const Packing> next() {
    auto packing = std::make_shared<const Packing>();
    const std::lock_guard lock(mutex_);
    names_[packing.get()] = engine_ + "-" + std::to_string(names_.size());
    kept_.push_back(packing);
    return packing;
  }
  std::string of(const Packing* packing) const {
    const std::lock_guard lock(mutex_);
    return names_.at(packing);
  }

 private:
  const std::string engine_;
  mutable std::mutex mutex_;
  std::map<const Packing*, std::string> names_;
  std::vector<std::shared_ptr<const Packing>> kept_;  // keeps their addresses unique
};

/// Result of the Python function; empty if stopped. Throws std::runtime_error for a Python error, so that no
/// interpreter object is used without its lock.
std::string answer_to(const py::function& ask, const std::string& task, const RunOptions& options) {
  const py::gil_scoped_acquire lock;
  try {
    const py::cpp_function goes_on([&] { return options.pulse({}); }, py::call_guard<py::gil_scoped_release>());
    const py::object answer = ask(task, goes_on);
    return answer.is_none() ? std::string() : answer.cast<std::string>();
  } catch (const py::error_already_set& error) {
    throw std::runtime_error(error.what());
  }
}

Outcome outcome_of(const std::string& answer) {
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

}  // namespace

Engine engine_of(py::function ask, std::string name) {
  // Threads without the interpreter's lock copy and destroy the engine.
  const std::shared_ptr<py::function> function(new py::function(std::move(ask)), [](py::function* held) {
    const py::gil_scoped_acquire lock;
    delete held;
  });
  const auto names = std::make_shared<PackingNames>(std::move(name));
  Engine engine;
  engine.prepare = [names](const Test&, const RunOptions&) { return names->next(); };
  engine.run = [names, function](const Test& test, const RunOptions& options) {
    return outcome_of(answer_to(*function, task_json(test, options, names->of(options.packing.get())).dump(), options));
  };
  return engine;
}

void add_tasks(py::module_& module) {
  module.def("simulate_task", simulate_task, py::call_guard<py::gil_scoped_release>());
  module.def("failed_task", [](const std::string& message) {
    Failure failure;
    failure.reason = FailureReason::engine_failed;
    failure.message = message;
    return nlohmann::ordered_json{{"failure", to_json(std::optional(failure))}}.dump();
  });
}

}  // namespace pastefit::python
