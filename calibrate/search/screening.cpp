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

bool ScreeningPhase::advance() {
  EvaluationHistory& history = state_.history;
  if (known_ < 0) {
    history.enter("screening");
    known_ = static_cast<int>(history.singles().size());
  }
  const bool enough = history.any_feasible() && known_ + asked_ >= state_.options.screening;
  if (enough || history.stop_requested()) return true;
  const int missing = state_.options.screening - (history.any_feasible() ? known_ + asked_ : 0);
  const int count = std::min(missing, history.budget_left());
  const int most = state_.options.budget_simulations / state_.scoring().simulations_each() / 2;
  if (count < 1 || asked_ > most) return true;
  const auto points = likely_points(state_, asked_ + count);
  history.try_out(std::span(points).last(static_cast<std::size_t>(count)), std::span(state_.common).first(1));
  asked_ += count;
  return false;
}

bool CoarseScreeningPhase::advance() {
  if (asked_) return true;
  asked_ = true;
  state_.history.enter("screening");
  state_.history.evaluate_coarse(likely_points(state_, state_.options.screening),
                                 packings_of_coarse(state_.options.seed, 1));
  return false;
}

}  // namespace pastefit
