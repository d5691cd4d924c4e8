#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "calibrate/base/worker_pool.h"
#include "calibrate/evaluate/objective.h"
#include "calibrate/evaluate/record.h"
#include "calibrate/evaluate/study_scoring.h"
#include "calibrate/laboratory/engine.h"
#include "calibrate/store/store.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"
#include "calibrate/study/tolerance.h"

namespace pastefit {

/// Counts the evaluations of one objective, each once, as soon as it is known.
struct EvaluationCounts {
  double core_s = 0;                      ///< processor time of those simulated [s]
  int simulated = 0;                      ///< simulated by this objective; one for each candidate, test and packing
  int answered = 0;                       ///< found in the store from an earlier run
  std::map<FailureReason, int> failures;  ///< of both, by reason
  double best_error = -1;                 ///< of the feasible candidates; negative: none yet

  EvaluationCounts& operator+=(const EvaluationCounts& other);  ///< adds those of another objective
};

struct EvaluatorOptions {
  int threads = 0;                          ///< simulations at a time; 0: one for each core
  int budget = 0;                           ///< total evaluations, known ones included; 0: the study's budget
  double wall_limit_s = 600;                ///< a longer simulation fails with `stopped`
  double wall_budget_s = 0;                 ///< from construction; then as if `stop` were true; 0: no limit
  double core_budget_s = 0;                 ///< processor time of all simulations; likewise
  const std::atomic<bool>* stop = nullptr;  ///< true: the user requests a stop
  std::function<void(const EvaluationCounts&)> observer;  ///< called after each evaluation, never concurrently
  std::function<void()> pulse;                            ///< called repeatedly during each simulation, from any thread
  RunObserver* run_observer = nullptr;                    ///< observes complete simulations, not those tried out
  Engine engine;
  /// Options of every simulation and preparation, except packing and watch, which are set here. With `own_fill` every
  /// simulation fills its own mould. Values other than the default belong into the identity of the store.
  RunOptions run;
};

/// Objective of a study: simulates candidates in parallel in every fitted test and stores every finished simulation
/// before its result is used. Known evaluations come from the store, so that a repeated search takes the same path.
/// Simulations run in the order of `begin`; the budget counts requested answers. Candidates with the same
/// `preparation_key` share a prepared packing.
///
/// Requirements: `study` and `store` outlive the objective; those of `StudyScoring`.
///
/// A candidate that is tried out may end early (`early_end.h`) and is then stored under its own key, so that it never
/// replaces a complete run. It keeps no energy balance; if it runs to its end, it has the same readings as one with an
/// energy balance and replaces it on the same packing. Confirmations use packings on which nothing was tried out.
///
/// On a stop request, running simulations end at their next watch, fail with `stopped` and are not stored. A simulation
/// that exceeds the wall limit is stored, so that a resumed search takes the same path; only its result may depend on
/// the load of the machine.
///
/// Limits: a batch that exceeds the budget is answered in full; the caller checks `budget_left` first. Errors: throws
/// std::logic_error for points outside the unit cube. A full disk sets `store_faults` and requests a stop.
class SimulationObjective : public Objective, public StudyScoring {
 public:
  SimulationObjective(const Study& study, Store& store, EvaluatorOptions options);
  SimulationObjective(const SimulationObjective&) = delete;
  SimulationObjective& operator=(const SimulationObjective&) = delete;
  ~SimulationObjective() override;  ///< ends running simulations as a stop request does

  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override;
  std::vector<Response> try_out(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override;
  void begin(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings, bool may_end_early) override;
  int budget_left() const override;
  int simulations_left() const override;
  std::vector<Response> earlier() const override;
  bool stop_requested() const override;

  /// Evaluates a candidate in one test, fitted or not, on each packing, in their order; counts in the budget.
  std::vector<StoredEvaluation> predict(const UnitPoint& point, std::span<const std::uint64_t> packings,
                                        std::size_t test);

  EvaluationCounts counts() const;
  Faults store_faults() const;  ///< empty unless an evaluation could not be stored

 private:
  /// One simulation, shared by all answers that need it.
  struct Task {
    std::size_t index = 0;         // of the test in the study
    bool tried = false;            // see `try_out`
    std::optional<Cutoff> cutoff;  // if tried out
    RunObserver::Watch look;       // empty: not observed
    StoredEvaluation evaluation;
    bool finished = false;          // not cut off by a stop
    std::shared_future<void> done;  // invalid if known from the store
  };

  /// Finds or enqueues every point on every packing in every one of these tests, in that order. `tried`: stops runs
  /// outside their cutoff (`early_end.h`).
  std::vector<Task*> begun(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                           std::span<const std::size_t> tests, bool tried);
  /// Waits for the same. `fresh`: for each, true if not answered before.
  std::vector<StoredEvaluation> answers(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                                        std::span<const std::size_t> tests, bool tried,
                                        std::vector<bool>* fresh = nullptr);
  std::vector<Response> responses_of(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                                     bool tried);
  void run(Task& task);
  void count(const StoredEvaluation& evaluation, std::size_t test, bool from_store);
  /// Prepared packing shared by all candidates with this preparation of the test; `look` observes it if it is made now.
  std::shared_ptr<const Packing> packing(std::size_t index, const Test& test, const RunObserver::Watch& look);
  /// Passes snapshots to `look`, and ends the simulation on a stop or at its wall limit since `start`.
  void watch(RunOptions& options, std::chrono::steady_clock::time_point start, const RunObserver::Watch& look,
             bool* by_user = nullptr) const;

  const Study& study_;
  Store& store_;
  EvaluatorOptions options_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::map<std::string, Task> tasks_;      // all ever begun, by store key
  std::unordered_set<std::string> asked_;  // answered evaluations, which count in the budget
  std::atomic<bool> closing_ = false;

  mutable std::mutex mutex_;  // guards what follows
  std::map<std::tuple<std::size_t, std::uint64_t, std::string>, std::shared_future<std::shared_ptr<const Packing>>>
      packings_;
  std::unordered_set<std::string> counted_;
  EvaluationCounts counts_;
  Faults store_faults_;

  WorkerPool pool_;  // last: its threads use all of the above
};

}  // namespace pastefit
