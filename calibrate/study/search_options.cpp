#include "calibrate/study/search_options.h"

#include <nlohmann/json.hpp>
#include <string>

namespace pastefit {

void read_search_options(ObjectReader& document, int fitted_tests, SearchOptions& search) {
  constexpr int most = 1'000'000;
  document.object("search", Need::optional, [&](ObjectReader& reader) {
    reader.text("strategy", search.strategy, Need::optional);
    reader.integer("screening", search.screening, 0, most, Need::optional);
    reader.integer("budget_simulations", search.budget_simulations, 1, most, Need::optional);
    reader.integer("packings", search.packings, 1, 1000, Need::optional);
    reader.former("lag", "max_pending");
    reader.integer("max_pending", search.max_pending, 0, 1000, Need::optional);
    reader.integer("confirmation_packings", search.confirmation_packings, 1, 1000, Need::optional);
    reader.number("rejected_share", search.rejected_share, {0, 1}, Need::optional);
    reader.integer("examination_simulations", search.examination_simulations, 0, most, Need::optional);
    reader.nullable_number("tolerance_mm", search.tolerance_mm, {1e-6, 1000}, Need::optional);
    reader.flag("coarse_first", search.coarse_first, Need::optional);
    reader.flag("end_early", search.end_early, Need::optional);
    reader.integer("seed", search.seed, Need::optional);
    const int least = (search.packings + search.confirmation_packings) * fitted_tests;
    if (search.budget_simulations < least)
      reader.fault("budget_simulations",
                   std::to_string(search.budget_simulations) + " simulations do not pay for one candidate (packings " +
                       std::to_string(search.packings) + ") and its confirmation (confirmation_packings " +
                       std::to_string(search.confirmation_packings) + ")" +
                       (fitted_tests > 1 ? " in " + std::to_string(fitted_tests) + " tests" : ""),
                   "at least " + std::to_string(least));
  });
}

}  // namespace pastefit
