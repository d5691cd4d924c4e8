#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "calibrate/optimisers/problem.h"
#include "calibrate/search/proposals.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// Runs an optimiser directly on the simulations, on all common packings. Optimisers call back and cannot wait: at an
/// unknown answer the optimiser is aborted, and restarted with all known answers after the simulation has finished.
/// Requirement: the optimiser is deterministic, as those of `calibrate/optimisers` are. The computing time of the
/// restarts is negligible compared with a simulation.
class SimulatedMinimisation : public SearchPhase {
 public:
  /// `minimise`: runs the optimiser on the given problem. `goal`: error at or below which a candidate is good enough;
  /// 0: none.
  SimulatedMinimisation(StrategyState& state, double goal, std::function<void(const Problem&)> minimise)
      : state_(state), goal_(goal), minimise_(std::move(minimise)) {}
  bool advance() override;

 private:
  std::vector<Answer> answers_of(std::span<const Response> responses) const;

  StrategyState& state_;
  const double goal_;
  const std::function<void(const Problem&)> minimise_;
  bool asked_ = false;
  std::vector<std::vector<Answer>> answers_;  // to its requests so far, in order
  std::vector<bool> allowed_;                 // decisions on its requests so far
};

/// Proposes candidates from the surrogate and takes answers in the order of the proposals, until a candidate is likely
/// to be confirmed. Proposal k uses the answers up to k - 1 - max_pending, and of later candidates only the points, so
/// that the order in which simulations finish does not matter.
class ProposalPhase : public SearchPhase {
 public:
  ProposalPhase(StrategyState& state, bool with_coarse)
      : state_(state), proposals_(state.history, with_coarse, state.options) {}
  bool advance() override;

 private:
  enum class Awaits { nothing, coarse, candidate, whole };  // `whole`: complete run of a stopped candidate
  bool propose();

  StrategyState& state_;
  Proposals proposals_;
  Awaits awaits_ = Awaits::nothing;
  std::optional<CandidateRanking> known_;  // after the last answer
};

/// Search phase of the chosen strategy: the surrogate, or an optimiser with half of the remaining budget.
std::unique_ptr<SearchPhase> candidate_phase(StrategyState& state, bool with_coarse);

/// Local descent from the best candidate. Returns none if its readings are likely to be confirmed, if the noise of the
/// common packings exceeds the allowed misfit, or if the search may not go on.
std::unique_ptr<SearchPhase> refinement_phase(StrategyState& state);

/// Brackets a discontinuous response to one free parameter: a heap may keep its shape or collapse, and a smooth
/// surrogate would call the readings within the jump out of reach. If all readings lie on one side of the measurement,
/// both ends of the range are simulated. Neighbours on opposite sides of the measurement that differ by many tolerances
/// are then bisected until a candidate is within the tolerances. Limit: does nothing with several free parameters.
class BracketPhase : public SearchPhase {
 public:
  explicit BracketPhase(StrategyState& state) : state_(state) {}
  bool advance() override;
  /// Point found by bisection whose error is at most 1 on its packing.
  const std::optional<UnitPoint>& found() const { return found_; }

 private:
  StrategyState& state_;
  bool begun_ = false;
  int halvings_ = 0;
  std::optional<UnitPoint> found_;
};

}  // namespace pastefit
