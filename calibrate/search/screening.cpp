#include "calibrate/search/screening.h"

#include <algorithm>
#include <span>
#include <vector>

#include "calibrate/search/low_fidelity.h"
#include "calibrate/search/space_filling.h"

namespace pastefit {

namespace {

/// The same however many of them are asked for.
std::vector<UnitPoint> likely_points(const StrategyState& state, int count) {
  const UnitBox box = state.scoring().likely_box();
  std::vector<UnitPoint> points = screening_points(state.scoring().parameters(), count, state.options.seed);
  for (UnitPoint& point : points) point = box.lower + point.cwiseProduct(box.upper - box.lower);
  return points;
}

}  // namespace

void screen(StrategyState& state) {
  state.history.enter("screening");
  const std::span<const std::uint64_t> first(state.common.data(), 1);
  const int known = static_cast<int>(state.history.singles().size());
  int asked = 0;
  while ((!state.history.any_feasible() || known + asked < state.options.screening) &&
         !state.history.stop_requested()) {
    const int missing = state.options.screening - (state.history.any_feasible() ? known + asked : 0);
    const int count = std::min(missing, state.history.budget_left());
    if (count < 1 || asked > state.options.budget_simulations / state.scoring().simulations_each() / 2) return;
    const auto points = likely_points(state, asked + count);
    state.history.try_out(std::span(points).last(static_cast<std::size_t>(count)), first);
    asked += count;
  }
}

void screen_coarsely(StrategyState& state) {
  state.history.enter("screening");
  const auto points = likely_points(state, state.options.screening);
  state.history.evaluate_coarse(points, packings_of_coarse(state.options.seed, 1));
}

}  // namespace pastefit
