#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/study/parameters.h"
#include "calibrate/study/schemas.h"

namespace pastefit {

namespace {

void describe_search_options(auto& fields, SearchOptions& search) {
  constexpr int most = 1'000'000;
  fields.text({"strategy", "\"default\", or the name of another strategy in calibrate/search/README.md"},
              search.strategy, Need::optional);
  fields.integer(
      {"screening", "number of candidates, spread over the bounds, that are simulated before the search; default 8"},
      search.screening, 0, most, Need::optional);
  fields.integer(
      {"budget_simulations", "largest number of simulations, including confirmation and examination; default 60"},
      search.budget_simulations, 1, most, Need::optional);
  fields.integer(
      {"packings",
       "number of random packings that all candidates of an optimiser and all coarse simulations share; default 2"},
      search.packings, 1, 1000, Need::optional);
  fields.integer(
      {"max_pending", "number of candidates that may still be running when the next candidate is chosen; default 0"},
      search.max_pending, 0, 1000, Need::optional);
  fields.integer(
      {"confirmation_packings", "number of new packings for the first decision on the best candidate; default 4"},
      search.confirmation_packings, 1, 1000, Need::optional);
  fields.number({"rejected_share",
                 "largest accepted share of heaps that shear off; 1: the share is not judged; default: 0.2, or the "
                 "measured share (`repeats` in the laboratory file) if that is larger"},
                search.rejected_share, {0, 1}, Need::optional);
  fields.integer(
      {"examination_simulations",
       "number of simulations in the budget for the examination of other materials that may fit; default 12"},
      search.examination_simulations, 0, most, Need::optional);
  fields.nullable_number({"tolerance_mm",
                          "tolerance of every length without an entry in `tolerances`; null or left out: the standard "
                          "deviation of the measurement, but at least half a grain radius for a heap"},
                         search.tolerance_mm, {1e-6, 1000}, Need::optional);
  fields.flag({"coarse_first", "true: candidates are first simulated with coarse grains"}, search.coarse_first,
              Need::optional);
  fields.flag({"end_early", "false: simulations are not stopped even if the heap sinks far below the measured height"},
              search.end_early, Need::optional);
  fields.integer({"seed", "seed of the search and of its packings; default 1"}, search.seed, Need::optional);
}

}  // namespace

void read_search_options(ObjectReader& document, int fitted_tests, SearchOptions& search) {
  document.object("search", Need::optional, [&](ObjectReader& reader) {
    reader.refuse("lag", "is a key of earlier programs", "max_pending");
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
  study.object({"search", "options of the search (calibrate/search/README.md)"}, Need::optional,
               [&](ObjectSchema& fields) { describe_search_options(fields, any); });
}

namespace {

/// Smallest distance between two bounds, as a fraction of the larger one, and largest ratio of bounds on a logarithmic
/// scale. Beyond either limit, a coordinate between them has no significant digits.
constexpr double narrowest = 1e-6, farthest_apart = 1e12;

/// Standard deviation of a prior, as a fraction of the distance between the bounds. A narrower prior is a fixed value;
/// a wider one carries no information.
constexpr Range prior_deviations{1e-6, 1e6};

/// Checks that the distance between the bounds is numerically usable; adds a fault if not.
bool check_bounds(ObjectReader& reader, const std::vector<double>& bounds, Scale scale) {
  const std::string both = "the bounds " + shown(bounds[0]) + " and " + shown(bounds[1]) + " are ";
  const auto refused = [&](const std::string& what, std::string remedy) {
    reader.fault("free", what, std::move(remedy));
    return false;
  };
  if (bounds[0] >= bounds[1])
    return refused(both + "not in order", "[lower, upper], lower below upper; for a fixed parameter give \"value\"");
  if (bounds[1] - bounds[0] < narrowest * std::max(std::abs(bounds[0]), std::abs(bounds[1])))
    return refused(both + "the same within a millionth", "wider ones; for a fixed parameter give \"value\"");
  if (scale == Scale::linear) return true;
  if (bounds[0] <= 0)
    return refused("a lower bound of " + shown(bounds[0]) + " has no logarithm",
                   "a lower bound above 0, or \"scale\": \"linear\"");
  if (bounds[0] * farthest_apart < bounds[1])
    return refused(both + "too far apart for a logarithmic scale",
                   "a lower bound of at least " + shown(bounds[1] / farthest_apart) + ", or \"scale\": \"linear\"");
  return true;
}

/// Requirement: the bounds of the parameter are valid.
void read_prior(ObjectReader& known, Parameter& parameter, const Range& range) {
  Prior prior{0, 1};
  Range admissible{0, largest_quantity, true};
  const bool given = known.number("value", prior.value, range, Need::required);
  const bool within = given && prior.value >= parameter.lower && prior.value <= parameter.upper;
  if (given && !within)
    known.fault(
        "value",
        shown(prior.value) + " contradicts the bounds " + shown(parameter.lower) + " to " + shown(parameter.upper),
        "a value within them, or bounds that hold it");
  if (within) {
    parameter.prior = prior;
    const double between_bounds = 1 / unit_prior(parameter).deviation;
    admissible = {prior_deviations.smallest * between_bounds, prior_deviations.largest * between_bounds};
  }
  const bool spread = known.number("standard_deviation", prior.standard_deviation, admissible, Need::required);
  parameter.prior.reset();
  if (within && spread) parameter.prior = prior;
}

}  // namespace

void tell_parameter(ObjectSchema& parameters, const ParameterKind& kind) {
  const Range range{kind.smallest, kind.largest};
  const auto fixed = parameters.described([&](ObjectSchema& form) { form.number("value", 0, range, Need::required); });
  const auto free = parameters.described([&](ObjectSchema& form) {
    form.numbers("free", {}, range, Need::required, 2, 2);
    form.choice("scale", kind.scale, scales, Need::optional);
    form.object("prior", Need::optional, [](ObjectSchema& prior) {
      prior.shared("prior");
      prior.number({"value", "mean of the prior, within the bounds"}, 0, Range{}, Need::required);
      prior.number({"standard_deviation",
                    "standard deviation of the prior; at least a millionth and at most a million times the distance "
                    "between the bounds"},
                   0, {0, largest_quantity, true}, Need::required);
    });
  });
  parameters.put({kind.name, kind.meaning}, {{"oneOf", {fixed, free}}}, Need::optional);
}

void read_free(ObjectReader& reader, const Range& range, Parameter& parameter) {
  parameter.free = true;
  reader.refuse("value", "stands beside \"free\"", "give one of them");
  reader.choice("scale", parameter.scale, scales, Need::optional);
  std::vector<double> bounds;
  reader.known("prior");
  if (!reader.numbers("free", bounds, range, Need::required, 2, 2)) return;
  if (!check_bounds(reader, bounds, parameter.scale)) return;
  parameter.lower = bounds[0];
  parameter.upper = bounds[1];
  reader.object("prior", Need::optional, [&](ObjectReader& known) { read_prior(known, parameter, range); });
}

}  // namespace pastefit
