#pragma once

#include <memory>
#include <optional>

#include "calibrate/optimisers/ceres.h"
#include "calibrate/search/proposals.h"
#include "calibrate/search/strategy_state.h"

namespace pastefit {

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

}  // namespace pastefit
