#pragma once

#include "calibrate/search/strategy_state.h"

namespace pastefit {

/// The first phase: space-filling points, tried out on one packing, all at once. If everything fails, further points of
/// the same sequence look elsewhere, while half of the budget lasts.
void screen(StrategyState& state);

/// The same with coarse grains.
void screen_coarsely(StrategyState& state);

}  // namespace pastefit
