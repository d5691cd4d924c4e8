#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "calibrate/laboratory/sketch.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/optimisers/problem.h"
#include "calibrate/store/store.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// Numbers of simulations, each counted once, as soon as it is known; one for each candidate, test and packing.
struct EvaluationCounts {
  int simulated = 0;
  int answered = 0;                       ///< found in the store from an earlier run
  std::map<FailureReason, int> failures;  ///< of both, by reason
  double best_error = -1;                 ///< of the feasible candidates; negative: none yet

  int known() const { return simulated + answered; }
};

/// One simulation of a calibration: a candidate in one test.
struct Simulation {
  std::size_t candidate = 0;  ///< number in the order of asking; the same in all its tests
  std::shared_ptr<const Study>
      study;             ///< with coarse grains or another condition, if so; null: a problem without tests
  std::size_t test = 0;  ///< of the study
  UnitPoint point;
  std::uint64_t packing = 0;
  bool may_end_early = false;  ///< may end as soon as the candidate is clearly worse, and omits the energy balance
  std::string purpose;         ///< phase: "screening", "search", "refinement", "confirmation", "examination"
};

/// The test with the candidate's material and packing. Requirement: there is a study.
Test test_of(const Simulation& simulation);

/// Range outside which it may end early; empty if it may not.
std::optional<Cutoff> cutoff_of(const Simulation& simulation);

/// Its evaluation before the result is known: key, point, values and packing.
StoredEvaluation unanswered(const Simulation& simulation, std::string_view program);

/// Enters the result of the engine. `cutoff`: of the simulation.
void enter(StoredEvaluation& evaluation, Outcome outcome, const std::optional<Cutoff>& cutoff);

/// Stored evaluation, as the search sees it: censored by the cutoff, if there is one.
std::optional<StoredEvaluation> find(const Store& store, const Simulation& simulation);

// Early end of simulations whose candidate cannot win.

/// Range of the reading that ends a test early (`ReadingKind::ends_early`). Within it a candidate runs to its end,
/// beyond it a run may be stopped. Its limits differ from the measurement by
///     level = the larger of 8 tolerances and 4 standard deviations of one measurement.
/// Beyond them a candidate cannot win and its likelihood is below e^-8, so that further readings do not matter. The
/// level depends on the study only, so that evaluations do not depend on the order of asking. The upper limit is used
/// only if readings of later stages are fitted. Empty if the study disables it (`SearchOptions::end_early`) or does not
/// fit that reading.
std::optional<Cutoff> cutoff_of(const Study& study, std::size_t test);

/// Store key of an evaluation that ended early, from the key of the complete one.
std::string key_of_ended(const std::string& whole_key, const Cutoff& cutoff);

/// Censors an evaluation by a cutoff, whether it ran to its end or not:
///   - below the cutoff its lower end replaces the reading, and all others of its stage and later are missing;
///   - above the cutoff the readings of later stages are missing;
///   - `run.ended_early` is true.
/// Stopped and complete runs thus give the same readings. A failure is kept; the only difference is a failure after the
/// run has left the range.
StoredEvaluation seen_through(const Test& test, const Cutoff& cutoff, StoredEvaluation evaluation);

/// True if a censored reading is the lower end of the cutoff, an upper bound of the true reading.
bool is_upper_bound(const Study& study, std::size_t test, std::string_view reading, double value);

/// Evaluation of a key, censored by the cutoff; without cutoff the complete one.
std::optional<StoredEvaluation> find(const Store& store, const Test& test, const std::string& whole_key,
                                     const std::optional<Cutoff>& cutoff);

// A simulation that another process runs, as JSON text, and its answer.

/// Everything that the simulation depends on. `packing`: name of the prepared packing; tasks with the same one share
/// it.
std::string task_text(const Test& test, const RunOptions& options, const std::string& packing);

/// Runs a task; returns the answer. This process keeps the packings of its latest tasks, each filled once. Thread-safe.
/// Errors: throws `Refusal` or nlohmann::json::exception for text that `task_text` does not write.
std::string simulate_task(const std::string& task);

/// Answer of a task that could not be run.
std::string failed_task(const std::string& message);

struct TaskAnswer {
  Outcome outcome;
  Sketch sketch;      ///< no points: none
  double wall_s = 0;  ///< wall time of the simulation
};

/// Reads an answer; empty text: stopped. Errors: throws for text that the functions above do not write.
TaskAnswer answer_of_task(const std::string& answer);

}  // namespace pastefit
