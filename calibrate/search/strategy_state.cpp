#include "calibrate/search/strategy_state.h"

#include <algorithm>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/optimisers/problem.h"

namespace pastefit {

std::optional<StrategyKind> kind_of_strategy(std::string_view name) {
  if (name == "default") return StrategyKind::surrogate;
  if (trust_region_of(name)) return StrategyKind::ceres;
  if (std::ranges::count(nlopt_algorithm_names(), name) > 0) return StrategyKind::nlopt;
  return std::nullopt;
}

Faults validate(const SearchOptions& options, int parameters, int tests) {
  Faults faults;
  const auto demand = [&](bool holds, const char* where, std::string what, std::string remedy) {
    if (!holds) faults.push_back({where, std::move(what), std::move(remedy)});
  };
  demand(parameters >= 1, "parameters", "none is free", "free at least one");
  demand(kind_of_strategy(options.strategy).has_value(), "search.strategy", "\"" + options.strategy + "\" is not known",
         "default, levenberg_marquardt, dogleg, or one of " + listed(nlopt_algorithm_names()));
  demand(options.screening >= 1, "search.screening", std::to_string(options.screening), "at least 1");
  demand(options.packings >= 1, "search.packings", std::to_string(options.packings), "at least 1");
  demand(options.max_pending >= 0, "search.max_pending", std::to_string(options.max_pending), "0 or more");
  demand(options.confirmation_packings >= 1, "search.confirmation_packings",
         std::to_string(options.confirmation_packings), "at least 1");
  const double tolerance_mm = options.tolerance_mm.value_or(1);
  demand(tolerance_mm > 0, "search.tolerance_mm", std::to_string(tolerance_mm), "above 0");
  const int least = (options.screening + options.packings + options.confirmation_packings) * tests;
  demand(options.budget_simulations >= least, "search.budget_simulations", std::to_string(options.budget_simulations),
         "at least " + std::to_string(least) + ": screening, one candidate and its confirmation");
  return faults;
}

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
