#include "tests/bench/speed/calibration.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <mutex>
#include <stdexcept>

#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/search/surrogate.h"
#include "calibrate/study/tests.h"
#include "core/observe/heap.h"
#include "core/world/world.h"
#include "tests/calibrate/search/simulation_objective.h"
#include "tests/calibrate/slump.h"

namespace pastefit {

namespace {

constexpr double kFixedWait = 0.5;                   // [s], as the peers of `test`
constexpr int kPlainBudget = 4;                      // of the study's
constexpr double kBelow = 0.005, kFarBelow = 0.040;  // [m]

Study study_of(const std::string& mix) {
  const auto file = std::filesystem::path(PASTEFIT_SOURCE_DIR) / "data/studies" / ("concrete-mix-" + mix + ".json");
  auto study = read_study(file);
  if (!study.ok()) throw std::runtime_error(message_of(study.faults()));
  return std::move(study).value();
}

/// The engine, watched: what steps it asked for, and how long it went on with heaps that had sunk below the target.
class WatchedEngine {
 public:
  explicit WatchedEngine(const Study& study) {
    for (const Measurement& measurement : study.tests.at(0).lab.measurements)
      if (measurement.reading == "step1.height_mm") target_m_ = 1e-3 * measurement.value;
  }

  Outcome run(const SlumpTest& test, const RunOptions& asked) {
    RunOptions options = asked;
    double below_since = -1, far_below_since = -1;
    options.watch = [&](const Snapshot& snapshot) {
      if (snapshot.world && !snapshot.phase.starts_with("fill")) {
        const double depth = target_m_ - highest_point(snapshot.world->particles);
        if (below_since < 0 && depth > kBelow + test.grains.radius_m) below_since = thread_seconds();
        if (far_below_since < 0 && depth > kFarBelow) far_below_since = thread_seconds();
      }
      return !asked.watch || asked.watch(snapshot);
    };
    const double start = thread_seconds();
    Outcome outcome = simulate(test, options);
    const double end = thread_seconds();
    const std::lock_guard lock(mutex_);
    seconds_ += end - start;
    if (below_since >= 0) seconds_below_ += end - below_since;
    if (far_below_since >= 0) seconds_far_below_ += end - far_below_since;
    if (!outcome.failure) advised_.push_back(outcome.run.advised_step_s);
    return outcome;
  }

  void tell(CalibrationCost& cost) {
    if (seconds_ > 0) {
      cost.share_below_target = seconds_below_ / seconds_;
      cost.share_far_below_target = seconds_far_below_ / seconds_;
    }
    if (advised_.empty()) return;
    std::ranges::sort(advised_);
    cost.smallest_advised_s = advised_.front();
    cost.median_advised_s = advised_[advised_.size() / 2];
  }

 private:
  double target_m_ = 0;
  std::mutex mutex_;
  double seconds_ = 0, seconds_below_ = 0, seconds_far_below_ = 0;
  std::vector<double> advised_;
};

CalibrationCost calibrate(const Study& study, const SearchOptions& options, const RunOptions& run,
                          const std::filesystem::path& file) {
  auto store = Store::open(file, {"pastefit-bench", inputs_of(study)});
  if (!store.ok()) throw std::runtime_error(message_of(store.faults()));
  WatchedEngine engine(study);
  PoolOptions pool;
  pool.run = run;
  pool.engine.run = of_slump([&](const SlumpTest& test, const RunOptions& asked) { return engine.run(test, asked); });
  const std::clock_t start = std::clock();
  const auto begin = std::chrono::steady_clock::now();
  SimulationObjective objective(study, store.value(), pool, options.budget_simulations);
  const Study coarse_study = with_coarse_grains(study);
  SimulationObjective coarse(coarse_study, store.value(), pool, options.budget_simulations);
  const Calibration calibration = search(objective, options, {}, {}, {}, options.coarse_first ? &coarse : nullptr);
  CalibrationCost cost;
  cost.core_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  cost.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  cost.simulations = calibration.simulations;
  cost.coarse_simulations = calibration.coarse_simulations;
  cost.simulation_s = cost.core_s / std::max(1, calibration.simulations);
  cost.status = calibration.status;
  if (calibration.confirmation.point.size() > 0)
    cost.confirmed_mm = calibration.confirmation.error * study.search.tolerance_mm.value_or(1);
  engine.tell(cost);
  return cost;
}

}  // namespace

std::vector<std::string> mixes() {
  return {"02", "04", "20", "66", "89"};
}

CalibrationCost calibrate_ours(const std::string& mix, std::uint64_t seed, bool coarse_first,
                               const std::filesystem::path& store) {
  const Study study = study_of(mix);
  SearchOptions options = study.search;
  options.seed = seed;
  options.coarse_first = coarse_first;
  return calibrate(study, options, {}, store);
}

CalibrationCost calibrate_plainly(const std::string& mix, std::uint64_t seed, const std::filesystem::path& store,
                                  double fixed_step_s) {
  const Study study = study_of(mix);
  SearchOptions options = study.search;
  options.seed = seed;
  options.strategy = "nelder_mead";
  options.screening = 1;
  options.budget_simulations *= kPlainBudget;
  RunOptions run;
  run.own_fill = true;
  run.fixed_wait_s = kFixedWait;
  run.steps.fixed_step_s = fixed_step_s;
  return calibrate(study, options, run, store);
}

}  // namespace pastefit
