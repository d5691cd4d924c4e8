#include "calibrate/search/recommendation.h"

#include <algorithm>

#include "calibrate/optimisers/nlopt.h"

namespace pastefit {
namespace {

constexpr int rounds = 3;

UnitPoint point_of_least_misfit(const CandidateRanking& ranking) {
  const auto misfit = [&](const UnitPoint& point) { return ranking.surrogate().misfit_posterior(point).mean(); };
  return least_point(misfit, ranking.best());
}

/// The completely simulated point of least expected misfit that no confirmation has rejected.
const UnitPoint& least_simulated(const CandidateRanking& ranking, const StrategyState& state) {
  const auto is_refuted = [&](const UnitPoint& point) {
    return std::ranges::any_of(state.refuted, [&](const UnitPoint& one) { return one == point; });
  };
  const UnitPoint* least = &ranking.best();
  double misfit = ranking.surrogate().misfit_posterior(*least).mean();
  for (const Response& one : state.history.singles()) {
    if (!is_whole(one) || is_refuted(one.point)) continue;
    const double expected = ranking.surrogate().misfit_posterior(one.point).mean();
    if (expected >= misfit) continue;
    misfit = expected;
    least = &one.point;
  }
  return *least;
}

}  // namespace

bool RecommendationPhase::advance() {
  const CandidateRanking ranking = state_.ranking();
  if (ranking.best().size() == 0) return true;
  if (simulated_ == rounds || !state_.may_go_on()) {
    const UnitPoint& least = least_simulated(ranking, state_);
    if (StrategyState::is_likely(ranking, least)) found_ = least;
    return true;
  }
  ++simulated_;
  const UnitPoint point = point_of_least_misfit(ranking);
  state_.history.evaluate({&point, 1}, state_.fresh_packings(1));
  return false;
}

}  // namespace pastefit
