#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

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

/// Range outside which it may end early (`early_end.h`); empty if it may not.
std::optional<Cutoff> cutoff_of(const Simulation& simulation);

/// Its evaluation before the result is known: key, point, values and packing.
StoredEvaluation unanswered(const Simulation& simulation, std::string_view program);

/// Enters the result of the engine. `cutoff`: of the simulation.
void enter(StoredEvaluation& evaluation, Outcome outcome, const std::optional<Cutoff>& cutoff);

/// Stored evaluation, as the search sees it: censored by the cutoff, if there is one.
std::optional<StoredEvaluation> find(const Store& store, const Simulation& simulation);

}  // namespace pastefit
