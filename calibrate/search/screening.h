#pragma once

#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// The first phase: space-filling points, tried out on one packing, all at once. If everything fails, further points of
/// the same sequence look elsewhere, while half of the budget lasts.
class ScreeningPhase : public SearchPhase {
 public:
  explicit ScreeningPhase(StrategyState& state) : state_(state) {}
  bool advance() override;

 private:
  StrategyState& state_;
  int known_ = -1;  // simulations when it began; negative: it has not
  int asked_ = 0;
};

/// The same with coarse grains, whose answers are not looked at.
class CoarseScreeningPhase : public SearchPhase {
 public:
  explicit CoarseScreeningPhase(StrategyState& state) : state_(state) {}
  bool advance() override;

 private:
  StrategyState& state_;
  bool asked_ = false;
};

}  // namespace pastefit
