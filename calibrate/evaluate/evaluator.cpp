#include "calibrate/evaluate/evaluator.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>
#include <utility>

#include "calibrate/base/machine.h"
#include "calibrate/evaluate/early_end.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/laboratory/engine.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWatchInterval = 0.002;  // simulated seconds; some ms of wall time, so that a stop acts at once

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Failure stopped(std::string message) {
  Failure failure;
  failure.reason = FailureReason::stopped;
  failure.message = std::move(message);
  return failure;
}

}  // namespace

EvaluationCounts& EvaluationCounts::operator+=(const EvaluationCounts& other) {
  core_s += other.core_s;
  simulated += other.simulated;
  answered += other.answered;
  for (const auto& [reason, count] : other.failures) failures[reason] += count;
  if (best_error < 0 || (other.best_error >= 0 && other.best_error < best_error)) best_error = other.best_error;
  return *this;
}

SimulationObjective::SimulationObjective(const Study& study, Store& store, EvaluatorOptions options)
    : StudyScoring(study),
      study_(study),
      store_(store),
      options_(std::move(options)),
      pool_(options_.threads > 0 ? options_.threads : processors()) {
  if (options_.budget <= 0) options_.budget = study.search.budget_simulations;
}

SimulationObjective::~SimulationObjective() {
  closing_ = true;
}

int SimulationObjective::budget_left() const {
  return simulations_left() / simulations_each();
}

int SimulationObjective::simulations_left() const {
  return std::max(0, options_.budget - static_cast<int>(asked_.size()));
}

bool SimulationObjective::stop_requested() const {
  if (closing_) return true;
  if (options_.stop && options_.stop->load(std::memory_order_relaxed)) return true;
  if (options_.wall_budget_s > 0 && seconds_since(start_) > options_.wall_budget_s) return true;
  const std::lock_guard lock(mutex_);
  if (options_.core_budget_s > 0 && counts_.core_s > options_.core_budget_s) return true;
  return !store_faults_.empty();
}

EvaluationCounts SimulationObjective::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

Faults SimulationObjective::store_faults() const {
  const std::lock_guard lock(mutex_);
  return store_faults_;
}

std::vector<SimulationObjective::Task*> SimulationObjective::begun(std::span<const UnitPoint> points,
                                                                   std::span<const std::uint64_t> packings,
                                                                   std::span<const std::size_t> tests, bool tried) {
  std::vector<Task*> tasks;
  for (const auto& point : points) {
    if (point.size() != parameters() || !point.allFinite() || point.minCoeff() < 0 || point.maxCoeff() > 1)
      throw std::logic_error("a candidate must lie in the unit cube over the free parameters");
    const auto values = values_at(study_, coordinates(point));
    for (const auto seed : packings) {
      for (const auto test : tests) {
        auto key = key_of(study_, test, values, seed, store_.identity().program);
        const auto cutoff = tried ? cutoff_of(study_, test) : std::nullopt;
        const auto [entry, added] = tasks_.try_emplace(cutoff ? key_of_ended(key, *cutoff) : key);
        Task& task = entry->second;
        tasks.push_back(&task);
        if (!added) continue;  // may be running: not touched here
        task.index = test;
        task.tried = tried;
        task.cutoff = cutoff;
        if (auto known = find(store_, study_.tests[test].lab.test, key, cutoff)) {
          task.evaluation = std::move(*known);
          task.finished = true;
          count(task.evaluation, test, true);
          continue;
        }
        auto& evaluation = task.evaluation;
        evaluation.key = std::move(key);
        evaluation.point.assign(point.begin(), point.end());
        evaluation.values = values;
        evaluation.packing = seed;
        evaluation.failure = stopped("The calibration was ended before this simulation; go on with --resume.");
        if (!tried && options_.run_observer)
          task.look = options_.run_observer->begin(test_with(study_.tests[test].lab.test, values, seed));
        task.done = pool_.submit([this, &task] { run(task); });
      }
    }
  }
  return tasks;
}

std::vector<StoredEvaluation> SimulationObjective::answers(std::span<const UnitPoint> points,
                                                           std::span<const std::uint64_t> packings,
                                                           std::span<const std::size_t> tests, bool tried,
                                                           std::vector<bool>* fresh) {
  const auto tasks = begun(points, packings, tests, tried);
  for (const Task* task : tasks)
    if (task->done.valid()) task->done.wait();
  std::vector<StoredEvaluation> out;
  for (Task* task : tasks) {
    if (task->done.valid()) task->done.get();  // rethrows exceptions of the engine
    const bool added = task->finished && asked_.insert(task->evaluation.key).second;
    if (fresh) fresh->push_back(added);
    out.push_back(task->cutoff ? seen_through(study_.tests[task->index].lab.test, *task->cutoff, task->evaluation)
                               : task->evaluation);
  }
  return out;
}

void SimulationObjective::begin(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                                bool may_end_early) {
  (void)begun(points, packings, fitted_tests(), may_end_early);
}

std::vector<Response> SimulationObjective::evaluate(std::span<const UnitPoint> points,
                                                    std::span<const std::uint64_t> packings) {
  return responses_of(points, packings, false);
}

std::vector<Response> SimulationObjective::try_out(std::span<const UnitPoint> points,
                                                   std::span<const std::uint64_t> packings) {
  return responses_of(points, packings, true);
}

std::vector<Response> SimulationObjective::responses_of(std::span<const UnitPoint> points,
                                                        std::span<const std::uint64_t> packings, bool tried) {
  std::vector<bool> fresh;
  const auto answered = answers(points, packings, fitted_tests(), tried, &fresh);
  std::vector<Response> responses;
  auto next = answered.begin();
  auto next_fresh = fresh.begin();
  for (const auto& point : points) {
    std::vector<Evaluation> evaluations;
    for (std::size_t i = 0; i < packings.size(); ++i, next += simulations_each(), next_fresh += simulations_each()) {
      evaluations.push_back(evaluation_of(point, merged(study_, fitted_tests(), {next, fitted_tests().size()})));
      evaluations.back().simulations = static_cast<int>(std::count(next_fresh, next_fresh + simulations_each(), true));
    }
    responses.push_back(response_of(std::move(evaluations)));
  }

  const std::lock_guard lock(mutex_);
  for (const auto& response : responses)
    if (!response.failed && !response.censored && (counts_.best_error < 0 || response.error < counts_.best_error))
      counts_.best_error = response.error;
  if (options_.observer) options_.observer(counts_);
  return responses;
}

std::vector<StoredEvaluation> SimulationObjective::predict(const UnitPoint& point,
                                                           std::span<const std::uint64_t> packings, std::size_t test) {
  return answers({&point, 1}, packings, {&test, 1}, false);
}

std::vector<Response> SimulationObjective::earlier() const {
  std::vector<Response> responses;
  for (const auto& stored : earlier_of(study_, store_)) {
    const UnitPoint point =
        Eigen::Map<const Eigen::VectorXd>(stored.point.data(), static_cast<Eigen::Index>(stored.point.size()));
    responses.push_back(response_of({evaluation_of(point, stored)}));
  }
  return responses;
}

void SimulationObjective::run(Task& task) {
  if (stop_requested()) return;
  const double core_start = thread_seconds();
  RunOptions options = options_.run;
  const auto& values = task.evaluation.values;
  const auto test = test_with(study_.tests[task.index].lab.test, values, task.evaluation.packing);
  Outcome outcome;
  outcome.failure = too_soft(test, options);
  if (!outcome.failure && !options.own_fill) options.packing = packing(task.index, test, task.look);
  if (stop_requested()) return;
  options.steps.energy_balance = options.steps.energy_balance && !task.tried;
  options.cutoff = task.cutoff;

  bool by_user = false;
  const auto start = Clock::now();
  watch(options, start, task.look, &by_user);
  Sketcher sketcher;
  options.watch = [&, goes_on = std::move(options.watch)](const Snapshot& snapshot) {
    sketcher.see(test, snapshot);
    return goes_on(snapshot);
  };
  if (!outcome.failure) outcome = options_.engine.run(test, options);
  if (by_user) return;
  if (task.look) options_.run_observer->end(test, outcome);

  auto& evaluation = task.evaluation;
  if (outcome.failure && outcome.failure->reason == FailureReason::stopped)
    outcome.failure->message = "The simulation took longer than its limit; use coarser or softer grains.";
  evaluation.failure = outcome.failure;
  if (!evaluation.failure) evaluation.readings = std::move(outcome.readings);
  evaluation.run = outcome.run;
  evaluation.sketch = sketcher.sketch(outcome);
  if (outcome.run.ended_early) evaluation.key = key_of_ended(evaluation.key, task.cutoff.value());
  evaluation.wall_s = seconds_since(start);
  evaluation.core_s = thread_seconds() - core_start;
  task.finished = true;

  auto faults = store_.add(evaluation);
  {
    const std::lock_guard lock(mutex_);
    counts_.core_s += evaluation.core_s;
  }
  if (!faults.empty()) {
    const std::lock_guard lock(mutex_);
    store_faults_ = std::move(faults);
    return;
  }
  count(evaluation, task.index, false);
}

void SimulationObjective::count(const StoredEvaluation& evaluation, std::size_t test, bool from_store) {
  const std::lock_guard lock(mutex_);
  if (!counted_.insert(evaluation.key).second) return;
  ++(from_store ? counts_.answered : counts_.simulated);
  if (const auto failure = failure_of(study_.tests[test], evaluation)) ++counts_.failures[failure->reason];
  if (options_.observer) options_.observer(counts_);
}

void SimulationObjective::watch(RunOptions& options, Clock::time_point start, const RunObserver::Watch& look,
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

std::shared_ptr<const Packing> SimulationObjective::packing(std::size_t index, const Test& test,
                                                            const RunObserver::Watch& look) {
  std::promise<std::shared_ptr<const Packing>> promise;
  std::shared_future<std::shared_ptr<const Packing>> future;
  bool ours = false;
  {
    const std::lock_guard lock(mutex_);
    const auto [entry, added] = packings_.try_emplace({index, specimen_of(test).packing_seed, preparation_key(test)});
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
