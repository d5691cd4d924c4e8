#pragma once

#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// Chooses the candidate to confirm among all that are likely to meet the readings: the point of least expected misfit,
/// priors included (the maximum a posteriori point; in Bayesian optimisation, the recommendation). Otherwise a search
/// would report whichever acceptable material it met first, which differs from seed to seed. Each of three rounds
/// simulates that point on a fresh packing and asks the surrogate again. Limit: the noise of the simulations shifts the
/// point; their number bounds how well two seeds agree. Requirement: the best candidate is likely to be confirmed
/// (`StrategyState::goal_is_met`).
class RecommendationPhase : public SearchPhase {
 public:
  explicit RecommendationPhase(StrategyState& state) : state_(state) {}
  bool advance() override;
  /// The simulated point; none if it is less likely to be confirmed than a confirmation requires.
  const UnitPoint& found() const { return found_; }

 private:
  StrategyState& state_;
  int simulated_ = 0;
  UnitPoint found_;
};

}  // namespace pastefit
