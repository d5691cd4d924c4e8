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

/// Tally of the evaluations one objective has begun; each is counted once, when it is known.
struct EvaluationCounts {
  double core_s = 0;                      ///< processor time of those finished now
  int simulated = 0;                      ///< finished now; a candidate in one test on one packing is one
  int answered = 0;                       ///< known to the store from an earlier run
  std::map<FailureReason, int> failures;  ///< of both, by reason
  double best_error = -1;                 ///< of the candidates that did not fail; negative: none yet

  EvaluationCounts& operator+=(const EvaluationCounts& other);  ///< the same of two objectives
};

struct EvaluatorOptions {
  int threads = 0;                          ///< simulations at the same time; 0: one for each core
  int budget = 0;                           ///< evaluations in all, known ones included; 0: the study's budget
  double wall_limit_s = 600;                ///< a simulation that takes longer fails with `stopped`
  double wall_budget_s = 0;                 ///< from now on; then as if `stop` had become true; 0: no end
  double core_budget_s = 0;                 ///< processor time of all simulations from now on; likewise
  const std::atomic<bool>* stop = nullptr;  ///< becomes true when the user wants to end
  std::function<void(const EvaluationCounts&)> observer;  ///< after each evaluation, never two calls at a time
  std::function<void()> pulse;                            ///< now and then during each, from any thread
  RunObserver* run_observer = nullptr;                    ///< of the simulations that are not only tried out
  Engine engine;
  /// How every simulation and preparation is run; packing and watch are set here. With `own_fill` every simulation
  /// fills its own mould. Other than the default it belongs into the identity of the store.
  RunOptions run;
};

/// The objective of a study: candidates are simulated in parallel in every test that is fitted, and every finished
/// simulation is stored before its answer is used. Known ones are answered from the store, so that a search that runs
/// again takes the same way. Simulations run in the order in which they were begun; the budget counts what was asked.
///
/// What a test starts from (`prepare`) is shared by the candidates for which it is the same (`preparation_key`).
///
/// A candidate that is tried out ends early where the study allows it (`early_end.h`). It is then stored under a name
/// of its own, so that it never stands in for one that ran to its end. It keeps no energy balance; where it
/// ran to its end it has the same readings as one with an energy balance and stands in for it on the same packing. A
/// confirmation has packings on which nothing was tried.
///
/// When a stop is requested, running simulations end at their next watch; they count as failed with `stopped` and are
/// not stored. One that reaches the wall limit is stored, so that a resumed search takes the same way; it is the one
/// answer that may depend on the machine's load.
///
/// Requirements: `study` and `store` outlive the objective; those of `StudyScoring`.
/// Limits: a batch that exceeds the budget is answered in full; the search looks at `budget_left` before it asks.
/// Errors: throws std::logic_error for points outside the unit cube. A full disk: `store_faults`, and a stop request.
class SimulationObjective : public Objective, public StudyScoring {
 public:
  SimulationObjective(const Study& study, Store& store, EvaluatorOptions options);
  SimulationObjective(const SimulationObjective&) = delete;
  SimulationObjective& operator=(const SimulationObjective&) = delete;
  ~SimulationObjective() override;  ///< ends what is under way, as a stop request would

  std::vector<Response> evaluate(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override;
  std::vector<Response> try_out(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings) override;
  void begin(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings, bool may_end_early) override;
  int budget_left() const override;
  int simulations_left() const override;
  std::vector<Response> earlier() const override;
  bool stop_requested() const override;

  /// A candidate in one test, fitted or not: one evaluation for each packing, in their order; part of the budget.
  std::vector<StoredEvaluation> predict(const UnitPoint& point, std::span<const std::uint64_t> packings,
                                        std::size_t test);

  EvaluationCounts counts() const;
  Faults store_faults() const;  ///< empty unless an evaluation could not be stored

 private:
  /// One simulation, however many answers need it.
  struct Task {
    std::size_t index = 0;         // of the test in the study
    bool tried = false;            // only tried out
    std::optional<Cutoff> cutoff;  // if it is
    RunObserver::Watch look;       // none unless somebody looks on
    StoredEvaluation evaluation;
    bool finished = false;          // not cut off by a stop
    std::shared_future<void> done;  // none if it is known from the store
  };

  /// Finds, or begins to simulate, every point on every packing in every one of these tests; in that order. `tried`:
  /// only as long as they are within their cutoff (`early_end.h`).
  std::vector<Task*> begun(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                           std::span<const std::size_t> tests, bool tried);
  /// Waits for the same. `fresh`: of each, true if it has not been answered before.
  std::vector<StoredEvaluation> answers(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                                        std::span<const std::size_t> tests, bool tried,
                                        std::vector<bool>* fresh = nullptr);
  std::vector<Response> responses_of(std::span<const UnitPoint> points, std::span<const std::uint64_t> packings,
                                     bool tried);
  void run(Task& task);
  void count(const StoredEvaluation& evaluation, std::size_t test, bool from_store);
  /// What all candidates with this preparation of the study's test share; `look` sees it if it is made now.
  std::shared_ptr<const Packing> packing(std::size_t index, const Test& test, const RunObserver::Watch& look);
  /// Has moments looked at, and ends the simulation that began then on a stop or at its limit.
  void watch(RunOptions& options, std::chrono::steady_clock::time_point start, const RunObserver::Watch& look,
             bool* by_user = nullptr) const;

  const Study& study_;
  Store& store_;
  EvaluatorOptions options_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::map<std::string, Task> tasks_;      // by their name in the store: all that were ever begun
  std::unordered_set<std::string> asked_;  // evaluations that were answered: what has been spent
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
