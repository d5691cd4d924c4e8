#include "calibrate/search/strategy_state.h"

namespace pastefit {
namespace {

constexpr double goal_share = 0.6;     // of the tolerances: within it a candidate is likely to be confirmed
constexpr double likely_enough = 0.5;  // probability of this at which a confirmation starts

/// Alternative: probability of being within the tolerances themselves. With 0.97 mix 79 took 200 further simulations,
/// since its good heaps shift by 30 mm of the allowed 40 mm; a confirmation takes 8.
constexpr double likely_to_hold = 0.75;

template <class Chance>
bool is_enough(const Chance& chance_within) {
  return chance_within(goal_share) >= likely_enough || chance_within(1) >= likely_to_hold;
}

}  // namespace

std::vector<std::uint64_t> StrategyState::fresh_packings(int count) {
  std::vector<std::uint64_t> packings;
  for (int k = 0; k < count; ++k) {
    if (++packings_used_ == first_examination_packing) packings_used_ = 1000;
    packings.push_back(options.seed * 1000 + packings_used_);
  }
  return packings;
}

bool StrategyState::is_likely(const CandidateRanking& ranking, const UnitPoint& candidate) {
  return is_enough([&](double tolerances) { return ranking.chance_of(candidate, tolerances); });
}

bool StrategyState::goal_is_met(const CandidateRanking& ranking) {
  return ranking.best().size() > 0 && is_likely(ranking, ranking.best());
}

bool StrategyState::readings_will_do(const CandidateRanking& ranking) {
  return ranking.best().size() > 0 &&
         is_enough([&](double tolerances) { return ranking.chance_of_readings(ranking.best(), tolerances); });
}

double StrategyState::optimisers_goal() const {
  return scoring().residuals() > scoring().readings() ? 0 : goal_share;
}

}  // namespace pastefit
