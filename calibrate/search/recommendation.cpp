#include "calibrate/search/recommendation.h"

#include "calibrate/optimisers/problem.h"

namespace pastefit {
namespace {

constexpr int rounds = 3;

UnitPoint point_of_least_misfit(const CandidateRanking& ranking) {
  const auto misfit = [&](const UnitPoint& point) { return ranking.surrogate().misfit_posterior(point).mean(); };
  return least_point(misfit, ranking.best());
}

}  // namespace

bool RecommendationPhase::advance() {
  const CandidateRanking ranking = state_.ranking();
  if (ranking.best().size() == 0) return true;
  if (simulated_ == rounds || !state_.may_go_on()) {
    if (StrategyState::is_likely(ranking, ranking.most_plausible())) found_ = ranking.most_plausible();
    return true;
  }
  ++simulated_;
  const UnitPoint point = point_of_least_misfit(ranking);
  state_.history.evaluate({&point, 1}, state_.fresh_packings(1));
  return false;
}

}  // namespace pastefit
