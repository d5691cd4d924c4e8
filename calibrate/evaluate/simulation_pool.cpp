#include "calibrate/evaluate/simulation_pool.h"

#include <utility>

#include "calibrate/base/machine.h"
#include "calibrate/laboratory/sketch.h"

namespace pastefit {

namespace {

constexpr double kWatchInterval = 0.002;  // simulated seconds; some ms of wall time, so that a stop acts at once

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

SimulationPool::SimulationPool(Store& store, PoolOptions options)
    : store_(store), options_(std::move(options)), pool_(options_.threads > 0 ? options_.threads : processors()) {}

SimulationPool::~SimulationPool() {
  closing_ = true;
}

bool SimulationPool::stop_requested() const {
  if (closing_) return true;
  if (options_.stop && options_.stop->load(std::memory_order_relaxed)) return true;
  if (options_.wall_budget_s > 0 && seconds_since(start_) > options_.wall_budget_s) return true;
  const std::lock_guard lock(mutex_);
  if (options_.core_budget_s > 0 && core_s_ > options_.core_budget_s) return true;
  return !store_faults_.empty();
}

Faults SimulationPool::store_faults() const {
  const std::lock_guard lock(mutex_);
  return store_faults_;
}

std::shared_ptr<SimulationPool::Run> SimulationPool::begin(Simulation simulation, bool observed) {
  auto task = std::make_shared<Run>();
  task->evaluation_ = unanswered(simulation, store_.identity().program);
  if (observed && options_.run_observer) task->look_ = options_.run_observer->begin(test_of(simulation));
  task->simulation_ = std::move(simulation);
  // The future keeps the work: it must not keep the run, which has the future.
  task->done_ = pool_.submit([this, weak = std::weak_ptr(task)] {
    if (const auto wanted = weak.lock()) run(*wanted);
  });
  return task;
}

bool SimulationPool::Run::is_over() const {
  return done_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::optional<StoredEvaluation> SimulationPool::wait(Run& run) {
  run.done_.get();
  return run.finished_ ? std::optional(run.evaluation_) : std::nullopt;
}

void SimulationPool::run(Run& task) {
  if (stop_requested()) return;
  const double core_start = thread_seconds();
  RunOptions options = options_.run;
  const Test test = test_of(task.simulation_);
  Outcome outcome;
  outcome.failure = too_soft(test, options);
  if (!outcome.failure && !options.own_fill) options.packing = packing(task.simulation_, test, task.look_);
  if (stop_requested()) return;
  options.steps.energy_balance = options.steps.energy_balance && !task.simulation_.may_end_early;
  options.cutoff = cutoff_of(task.simulation_);

  bool by_user = false;
  const auto start = Clock::now();
  watch(options, start, task.look_, &by_user);
  Sketcher sketcher;
  options.watch = [&, goes_on = std::move(options.watch)](const Snapshot& snapshot) {
    sketcher.see(test, snapshot);
    return goes_on(snapshot);
  };
  if (!outcome.failure) outcome = options_.engine.run(test, options);
  if (by_user) return;
  if (task.look_) options_.run_observer->end(test, outcome);

  if (outcome.failure && outcome.failure->reason == FailureReason::stopped)
    outcome.failure->message = "The simulation took longer than its limit; use coarser or softer grains.";
  StoredEvaluation& evaluation = task.evaluation_;
  evaluation.sketch = sketcher.sketch(outcome);
  enter(evaluation, std::move(outcome), options.cutoff);
  evaluation.wall_s = seconds_since(start);
  evaluation.core_s = thread_seconds() - core_start;
  task.finished_ = true;

  auto faults = store_.add(evaluation);
  const std::lock_guard lock(mutex_);
  core_s_ += evaluation.core_s;
  if (!faults.empty()) store_faults_ = std::move(faults);
}

void SimulationPool::watch(RunOptions& options, Clock::time_point start, const RunObserver::Watch& look,
                           bool* by_user) const {
  options.watch_interval_s = look ? options_.run_observer->interval_s() : kWatchInterval;
  options.pulse = [this, start, by_user](const Snapshot&) {
    const bool stopped = (by_user && *by_user) || stop_requested();
    if (by_user) *by_user = stopped;
    if (options_.pulse) options_.pulse();
    return !stopped && seconds_since(start) < options_.wall_limit_s;
  };
  options.watch = [look, goes_on = options.pulse](const Snapshot& snapshot) {
    if (look) look(snapshot);
    return goes_on(snapshot);
  };
}

std::shared_ptr<const Packing> SimulationPool::packing(const Simulation& simulation, const Test& test,
                                                       const RunObserver::Watch& look) {
  std::promise<std::shared_ptr<const Packing>> promise;
  std::shared_future<std::shared_ptr<const Packing>> future;
  bool ours = false;
  {
    const std::lock_guard lock(mutex_);
    const auto [entry, added] =
        packings_.try_emplace({simulation.study.get(), simulation.test, simulation.packing, preparation_key(test)});
    if (added) entry->second = promise.get_future().share();
    future = entry->second;
    ours = added;
  }
  if (ours) {
    try {
      RunOptions options = options_.run;
      watch(options, Clock::now(), look);
      promise.set_value(options_.engine.prepare(test, options));
    } catch (...) {
      promise.set_exception(std::current_exception());
    }
  }
  return future.get();
}

}  // namespace pastefit
