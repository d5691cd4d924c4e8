#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "calibrate/evaluate/simulation.h"
#include "calibrate/python/module.h"
#include "core/apparatus/slump/packing.h"

namespace pastefit::python {

namespace py = pybind11;

namespace {

/// Names of packings that are filled by the process that needs them.
class PackingNames {
 public:
  explicit PackingNames(std::string engine) : engine_(std::move(engine)) {}

  std::shared_ptr<const Packing> next() {
    auto packing = std::make_shared<const Packing>();
    const std::lock_guard lock(mutex_);
    names_[packing] = engine_ + "-" + std::to_string(names_.size());
    return packing;
  }
  std::string of(const std::shared_ptr<const Packing>& packing) const {
    const std::lock_guard lock(mutex_);
    return names_.at(packing);
  }

 private:
  const std::string engine_;
  mutable std::mutex mutex_;
  std::map<std::shared_ptr<const Packing>, std::string> names_;
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
    const std::string task = task_text(test, options, names->of(options.packing));
    return answer_of_task(answer_to(*function, task, options)).outcome;
  };
  return engine;
}

void add_tasks(py::module_& module) {
  module.def("simulate_task", simulate_task, py::call_guard<py::gil_scoped_release>());
  module.def("failed_task", failed_task);
}

}  // namespace pastefit::python
