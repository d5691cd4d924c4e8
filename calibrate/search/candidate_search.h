#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "calibrate/optimisers/ceres.h"
#include "calibrate/optimisers/problem.h"
#include "calibrate/search/proposals.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// An optimiser on the simulations themselves, on all common packings. Optimisers call back and cannot wait: where one
/// asks for what is not known it is ended, and run again from its start once that is answered, with the answers of
/// before. So it has to ask the same questions for the same answers, as those of `calibrate/optimisers` do; what an
/// optimiser computes itself is nothing beside a simulation.
class SimulatedMinimisation : public SearchPhase {
 public:
  /// `minimise`: runs the optimiser on the problem that it is given. A candidate whose error is at or below `goal` is
  /// good enough; 0: none is.
  SimulatedMinimisation(StrategyState& state, double goal, std::function<void(const Problem&)> minimise)
      : state_(state), goal_(goal), minimise_(std::move(minimise)) {}
  bool advance() override;

 private:
  std::vector<Answer> answers_of(std::span<const Response> responses) const;
  std::optional<Problem::Refusal> refusal_of(int points) const;

  StrategyState& state_;
  const double goal_;
  const std::function<void(const Problem&)> minimise_;
  bool asked_ = false;
  std::vector<std::vector<Answer>> answers_;               // to its questions so far, in order
  std::vector<std::optional<Problem::Refusal>> refusals_;  // whether they were allowed, as it was decided then
};

/// Brings candidates by the surrogate: proposes, and takes the answers in the order of the proposals, until a candidate
/// is likely to do. Proposal k knows the answers up to k - 1 - max_pending, of the others only that they were asked:
/// what is ready first does not matter.
class ProposalPhase : public SearchPhase {
 public:
  ProposalPhase(StrategyState& state, bool with_coarse)
      : state_(state), proposals_(state.history, with_coarse, state.options) {}
  bool advance() override;

 private:
  enum class Awaits { nothing, coarse, candidate, whole };  // `whole`: a candidate that ended early, to its end
  bool propose();

  StrategyState& state_;
  Proposals proposals_;
  Awaits awaits_ = Awaits::nothing;
  std::optional<CandidateRanking> known_;  // as the last answer left it
};

/// What brings candidates for the strategy of the options: the surrogate, or an optimiser with half of what is left of
/// the budget.
std::unique_ptr<SearchPhase> candidate_phase(StrategyState& state, bool with_coarse);

/// Descends from the best candidate where the surrogate sees no better one and none that will do, unless what is left
/// is luck. None where there is nothing to descend for.
std::unique_ptr<SearchPhase> refinement_phase(StrategyState& state);

/// Where one parameter is free, a response may jump: a heap stands or flows by a small change of a threshold, and a
/// smooth model of it says that what lies within the jump is out of reach. If no simulation has a reading beyond the
/// laboratory's, both ends of the range are simulated. Neighbours on either side of the laboratory that differ by many
/// tolerances are then halved until one of them meets it. Of several parameters nothing is asked.
class BracketPhase : public SearchPhase {
 public:
  explicit BracketPhase(StrategyState& state) : state_(state) {}
  bool advance() override;
  /// A point that was found by halving and meets the laboratory on its packing.
  const std::optional<UnitPoint>& found() const { return found_; }

 private:
  StrategyState& state_;
  bool begun_ = false;
  int halvings_ = 0;
  std::optional<UnitPoint> found_;
};

}  // namespace pastefit
