#include "calibrate/calibrate.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "calibrate/calibrator.h"
#include "calibrate/evaluate/cost.h"
#include "calibrate/evaluate/simulation_pool.h"
#include "calibrate/evaluate/study_scoring.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

/// Reasons why `coarse_first` cannot be used.
Faults coarse_faults(const Study& study) {
  const std::string where = "search.coarse_first";
  const auto why = [&](std::size_t test) { return why_of_that_size(study.tests[test].lab.test); };
  const auto fitted = tests_of(study, false);
  if (std::ranges::none_of(fitted, [&](std::size_t test) { return why(test).empty(); }))
    return {{where, std::string(why(fitted.front())), "leave it out"}};
  const Study coarse = with_coarse_grains(study);
  const std::vector<double> middle(static_cast<std::size_t>(free_count(study)), 0.5);
  for (const StudyTest& test : coarse.tests)
    if (const auto faults = validate_in_file_words(test_with(test.lab.test, values_at(coarse, middle), 1));
        !faults.empty())
      return {{where, "with coarse grains: " + faults.front().what, "leave it out, or take smaller grains"}};
  return {};
}

/// Simulations that a pool runs for a calibrator.
class UnderWay {
 public:
  UnderWay(SimulationPool& pool, const Study& observed) : pool_(pool), observed_(observed) {}

  void begin(const Simulation& one) {
    const bool observed = one.study.get() == &observed_ && !one.may_end_early;
    runs_.push_back({one, pool_.begin(one, observed)});
  }
  /// Waits for the first, and ingests all that are over. The pool keeps the fault of one that cannot be stored.
  void await(Calibrator& calibrator) {
    if (runs_.empty()) return;
    (void)SimulationPool::wait(*runs_.front().run);
    const auto over =
        std::stable_partition(runs_.begin(), runs_.end(), [](const One& one) { return !one.run->is_over(); });
    for (auto one = over; one != runs_.end(); ++one)
      if (const auto answer = SimulationPool::wait(*one->run)) (void)calibrator.ingest(one->simulation, *answer);
    runs_.erase(over, runs_.end());
  }

 private:
  struct One {
    Simulation simulation;
    std::shared_ptr<SimulationPool::Run> run;
  };
  SimulationPool& pool_;
  const Study& observed_;
  std::deque<One> runs_;
};

}  // namespace

Faults validate(const Study& study, int threads) {
  const auto fitted = static_cast<int>(tests_of(study, false).size());
  if (auto faults = validate(options_of_the_search(study), free_count(study), fitted); !faults.empty()) return faults;
  if (auto faults = validate_residuals(study); !faults.empty()) return faults;
  if (auto faults = validate_memory(study, threads); !faults.empty()) return faults;
  return study.search.coarse_first ? coarse_faults(study) : Faults{};
}

Result<CalibrationResult> calibrate(const Study& study, Store& store, const PoolOptions& options,
                                    const CalibrateCallbacks& callbacks, const std::string& study_file) {
  if (auto faults = validate(study, options.threads); !faults.empty()) return faults;
  StudyAnswers answers(std::shared_ptr<const Study>(std::shared_ptr<void>(), &study), store, study_file);
  Calibrator calibrator(answers, callbacks.progress);
  SimulationPool pool(store, options);
  UnderWay under_way(pool, study);
  while (!calibrator.finished()) {
    if (pool.stop_requested()) calibrator.stop(!options.stop || !*options.stop);
    const auto simulations = calibrator.suggest(std::numeric_limits<std::size_t>::max());
    for (const Simulation& one : simulations) under_way.begin(one);
    if (simulations.empty()) under_way.await(calibrator);
    if (callbacks.evaluated) callbacks.evaluated(calibrator.counts());
  }
  if (auto faults = pool.store_faults(); !faults.empty()) return faults;
  return calibrator.result();
}

}  // namespace pastefit
