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

#include "calibrate/base/worker_pool.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/laboratory/engine.h"
#include "calibrate/store/store.h"

namespace pastefit {

struct PoolOptions {
  int threads = 0;                          ///< simulations at a time; 0: one for each core
  double wall_limit_s = 600;                ///< a longer simulation fails with `stopped`
  double wall_budget_s = 0;                 ///< from construction; then as if `stop` were true; 0: no limit
  double core_budget_s = 0;                 ///< processor time of all simulations; likewise
  const std::atomic<bool>* stop = nullptr;  ///< true: the user requests a stop
  std::function<void()> pulse = {};         ///< called repeatedly during each simulation, from any thread
  RunObserver* run_observer = nullptr;      ///< observes those that are begun as observed
  Engine engine = {};
  /// Options of every simulation and preparation, except packing and watch, which are set here. With `own_fill` every
  /// simulation fills its own mould. Values other than the default belong into the identity of the store.
  RunOptions run = {};
};

/// Simulates in parallel, in the order of `begin`, and stores every finished simulation before its result is used.
/// Simulations of a study with the same `preparation_key` share a prepared packing. Requirement: `store` outlives the
/// pool.
///
/// A simulation that may end early and does is stored under its own key, so that it never replaces a
/// complete run. It keeps no energy balance; if it runs to its end, it has the same readings as one with an energy
/// balance and replaces it on the same packing. Confirmations use packings on which nothing was tried out.
///
/// On a stop request, running simulations end at their next watch, fail with `stopped` and are not stored. A simulation
/// that exceeds the wall limit is stored, so that a resumed search takes the same path; only its result may depend on
/// the load of the machine. Errors: a full disk sets `store_faults` and requests a stop.
class SimulationPool {
 public:
  SimulationPool(Store& store, PoolOptions options);
  SimulationPool(const SimulationPool&) = delete;
  SimulationPool& operator=(const SimulationPool&) = delete;
  ~SimulationPool();  ///< ends running simulations as a stop request does

  /// A simulation that was begun.
  class Run {
   public:
    bool is_over() const;

   private:
    friend class SimulationPool;
    Simulation simulation_;
    StoredEvaluation evaluation_;
    RunObserver::Watch look_;  // empty: not observed
    bool finished_ = false;    // not cut off by a stop
    std::shared_future<void> done_;
  };

  /// Starts a simulation that the store does not have; it is left out if nobody holds the run any more. Errors:
  /// std::logic_error for a point outside the unit cube.
  std::shared_ptr<Run> begin(Simulation simulation, bool observed = false);
  /// Waits for it; nothing if a stop cut it off. Errors: rethrows exceptions of the engine.
  static std::optional<StoredEvaluation> wait(Run& run);

  bool stop_requested() const;
  Faults store_faults() const;  ///< empty unless an evaluation could not be stored

 private:
  using Clock = std::chrono::steady_clock;
  using PackingKey = std::tuple<const Study*, std::size_t, std::uint64_t, std::string>;

  void run(Run& task);
  /// Prepared packing shared by all candidates with this preparation of the test; `look` observes it if it is made now.
  std::shared_ptr<const Packing> packing(const Simulation& simulation, const Test& test,
                                         const RunObserver::Watch& look);
  /// Passes snapshots to `look`, and ends the simulation on a stop or at its wall limit since `start`.
  void watch(RunOptions& options, Clock::time_point start, const RunObserver::Watch& look,
             bool* by_user = nullptr) const;

  Store& store_;
  const PoolOptions options_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<bool> closing_ = false;

  mutable std::mutex mutex_;  // guards what follows
  std::map<PackingKey, std::shared_future<std::shared_ptr<const Packing>>> packings_;
  double core_s_ = 0;  // processor time of the finished simulations
  Faults store_faults_;

  WorkerPool pool_;  // last: its threads use all of the above
};

}  // namespace pastefit
