#include "calibrate/search/strategies.h"

#include <algorithm>
#include <string>

#include "calibrate/optimisers/problem.h"

namespace pastefit {

const std::vector<StrategyRow>& strategies() {
  static const std::vector<StrategyRow> rows = [] {
    std::vector<StrategyRow> known{{"default", StrategyKind::surrogate},
                                   {"levenberg_marquardt", StrategyKind::ceres},
                                   {"dogleg", StrategyKind::ceres}};
    for (const std::string_view name : nlopt_algorithm_names()) known.push_back({name, StrategyKind::nlopt});
    return known;
  }();
  return rows;
}

const StrategyRow* find_strategy(std::string_view name) {
  const auto row = std::ranges::find(strategies(), name, &StrategyRow::name);
  return row == strategies().end() ? nullptr : &*row;
}

Faults validate(const SearchOptions& options, int parameters, int tests) {
  Faults faults;
  const auto demand = [&](bool holds, const char* where, std::string what, std::string remedy) {
    if (!holds) faults.push_back({where, std::move(what), std::move(remedy)});
  };
  demand(parameters >= 1, "parameters", "none is free", "free at least one");
  std::string algorithms;
  for (const std::string_view name : nlopt_algorithm_names())
    algorithms += (algorithms.empty() ? "" : ", ") + std::string(name);
  demand(find_strategy(options.strategy) != nullptr, "search.strategy", "\"" + options.strategy + "\" is not known",
         "default, levenberg_marquardt, dogleg, or one of " + algorithms);
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

}  // namespace pastefit
