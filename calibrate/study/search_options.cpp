#include "calibrate/study/search_options.h"

#include <nlohmann/json.hpp>
#include <string>

#include "calibrate/study/schemas.h"

namespace pastefit {

namespace {

template <class Fields>
void describe_search_options(Fields& fields, SearchOptions& search) {
  constexpr int most = 1'000'000;
  fields.text({"strategy", "\"default\", or the name of an algorithm (calibrate/search/README.md)"}, search.strategy,
              Need::optional);
  fields.integer({"screening", "candidates that are spread over the bounds to begin with; default 8"}, search.screening,
                 0, most, Need::optional);
  fields.integer({"budget_simulations", "simulations in all, confirmation and examination included; default 60"},
                 search.budget_simulations, 1, most, Need::optional);
  fields.integer({"packings",
                  "random packings that all candidates of an optimiser share, and those with coarse grains; default 2"},
                 search.packings, 1, 1000, Need::optional);
  fields.integer({"max_pending", "how many simulations may be under way when the next is chosen; default 0"},
                 search.max_pending, 0, 1000, Need::optional);
  fields.integer(
      {"confirmation_packings", "fresh packings on which the best candidate is judged, to begin with; default 4"},
      search.confirmation_packings, 1, 1000, Need::optional);
  fields.number({"rejected_share",
                 "of the heaps that a laboratory would reject because they sheared off, at most; 1: not judged; "
                 "default 0.2, or the laboratory's own share (`repeats` of its file), if that is more"},
                search.rejected_share, {0, 1}, Need::optional);
  fields.integer({"examination_simulations", "of the budget, for what else fits; default 12"},
                 search.examination_simulations, 0, most, Need::optional);
  fields.nullable_number({"tolerance_mm",
                          "of every length without a tolerance of its own; left out or null: the laboratory's "
                          "deviation, of a heap half a grain's radius at least"},
                         search.tolerance_mm, {1e-6, 1000}, Need::optional);
  fields.flag({"coarse_first", "coarse grains propose, fine ones decide"}, search.coarse_first, Need::optional);
  fields.flag({"end_early", "false: hopeless simulations run to their end, too"}, search.end_early, Need::optional);
  fields.integer({"seed", "of the search and of its packings; default 1"}, search.seed, Need::optional);
}

}  // namespace

void read_search_options(ObjectReader& document, int fitted_tests, SearchOptions& search) {
  document.object("search", Need::optional, [&](ObjectReader& reader) {
    reader.former("lag", "max_pending");
    describe_search_options(reader, search);
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

void tell_search_options(ObjectSchema& study) {
  SearchOptions any;
  study.object({"search", "how the search goes (calibrate/search/README.md)"}, Need::optional,
               [&](ObjectSchema& fields) { describe_search_options(fields, any); });
}

}  // namespace pastefit
