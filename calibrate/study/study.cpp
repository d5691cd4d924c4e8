#include "calibrate/study/study.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/base/content_hash.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"
#include "core/laws/table.h"

namespace pastefit {
namespace {

using nlohmann::json;

/// How wide the way between two bounds is at least, as a share of the larger one, and how far apart they are at most on
/// a logarithmic scale. Beyond either a coordinate between them has no digits that count.
constexpr double narrowest = 1e-6, farthest_apart = 1e12;

/// The standard deviation of a prior, as a share of the way between the bounds: narrower is a fixed value, wider says
/// nothing.
constexpr Range prior_deviations{1e-6, 1e6};

/// Whether a coordinate can be told between the bounds; a fault if not.
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

/// Requirement: the bounds of the parameter are good.
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

void read_parameter(ObjectReader& reader, const ParameterKind& kind, Parameter& parameter) {
  const Range range{kind.smallest, kind.largest};
  if (!reader.has("free")) {
    reader.number("value", parameter.value, range, Need::required);
    reader.refuse("scale", "a fixed parameter has no scale", "leave it out, or give \"free\": [lower, upper]");
    reader.refuse("prior", "a fixed parameter is known already", "leave it out, or give \"free\": [lower, upper]");
    return;
  }
  parameter.free = true;
  reader.refuse("value", "stands beside \"free\"", "give one of them");
  reader.choice("scale", parameter.scale, scales, Need::optional);
  std::vector<double> bounds;
  reader.known("prior");
  if (!reader.numbers("free", bounds, range, Need::required, 2, 2)) return;
  if (!check_bounds(reader, bounds, parameter.scale)) return;
  parameter.lower = bounds[0];
  parameter.upper = bounds[1];
  parameter.value = kind.default_value;
  reader.object("prior", Need::optional, [&](ObjectReader& known) { read_prior(known, parameter, range); });
}

/// The choice of laws.
ContactModel read_contact(ObjectReader& document) {
  ContactModel laws;
  laws.bridge.shape = BridgeShape::polynomial;
  document.object("contact", Need::optional, [&](ObjectReader& reader) {
    reader.choice("normal", laws.normal, normal_laws, Need::optional);
    reader.choice("attraction", laws.bridge.shape, bridge_shapes, Need::optional);
    reader.choice("formation", laws.bridge.formation, bridge_formations, Need::optional);
    reader.choice("rolling_model", laws.rolling, rolling_models, Need::optional);
    reader.choice("friction_basis", laws.friction_basis, friction_bases, Need::optional);
    if (!go_together(laws.normal, laws.bridge.shape))
      reader.fault("attraction",
                   "is " + in_quotes(word_of(laws.bridge.shape, bridge_shapes)) + " beside normal " +
                       in_quotes(word_of(laws.normal, normal_laws)) + ", which has none across a gap",
                   "\"attraction\": \"none\"");
  });
  return laws;
}

std::vector<Parameter> read_parameters(ObjectReader& document, const ContactModel& laws,
                                       const std::vector<StudyTest>& tests) {
  std::vector<Parameter> parameters;
  for (const ParameterKind& kind : parameter_kinds())
    parameters.push_back({std::string(kind.name), false, kind.default_value, 0, 0, kind.scale});
  document.object("parameters", Need::required, [&](ObjectReader& reader) {
    bool any_free = false;
    reader.former("offset_ratio",
                  "\"formation_ratio\": 2 offset_ratio/rupture_gap_ratio, at most 1; free: {\"free\": [0, 1]}");
    for (Parameter& parameter : parameters) {
      const ParameterKind& kind = parameter_kinds()[static_cast<std::size_t>(&parameter - parameters.data())];
      reader.object(kind.name, Need::optional, [&](ObjectReader& one) { read_parameter(one, kind, parameter); });
      if (reader.has(kind.name) && !has_parameter(laws, kind.name))
        reader.faults().push_back(foreign_parameter(laws, reader.place(kind.name), kind.name));
      else if (reader.has(kind.name) && std::ranges::none_of(tests, [&](const StudyTest& test) {
                 return test.lab.measurements.empty() || acts_in(test.lab.test, kind.name);  // or it was not read
               }))
        reader.faults().push_back(surface_of_no_test(reader.place(kind.name), kind.name));
      any_free = any_free || parameter.free;
      parameter.stated = reader.has(kind.name);
    }
    if (!any_free)
      document.fault("parameters", "none is free, so there is nothing to calibrate",
                     "free at least one, e.g. \"friction\": {\"free\": [0.05, 0.6]}");
  });
  return parameters;
}

void read_search(ObjectReader& document, int fitted_tests, SearchOptions& search) {
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

/// A material may shear off as often as the laboratory's did.
double rejected_share_of_labs(const std::vector<StudyTest>& tests, double least) {
  for (const StudyTest& test : tests)
    if (!test.hold_out) least = std::max(least, test.lab.repeats.sheared_share());
  return least;
}

void choose(const ContactModel& laws, Test& test) {
  ContactModel& contact = specimen_of(test).contact;
  contact.normal = laws.normal;
  contact.bridge.shape = laws.bridge.shape;
  contact.bridge.formation = laws.bridge.formation;
  contact.rolling = laws.rolling;
  contact.friction_basis = laws.friction_basis;
}

/// The point of the bounds' cube where everything free is at its upper bound, but the stiffness at its lower one: the
/// grains that are pressed into each other most.
std::vector<double> most_squeezed(const Study& study) {
  std::vector<double> point;
  for (const Parameter& parameter : study.parameters)
    if (parameter.free) point.push_back(parameter.name == "youngs_modulus_pa" ? 0 : 1);
  return point;
}

/// The study's test at the centre and at corners of its bounds: every point must be fit to run.
Faults validate_points(const Study& study) {
  const auto free = static_cast<std::size_t>(free_count(study));
  using Point = std::vector<double>;
  for (const Point& point : {Point(free, 0.5), Point(free, 0.0), Point(free, 1.0), most_squeezed(study)}) {
    const std::vector<double> values = values_at(study, point);
    for (const StudyTest& test : study.tests)
      if (Faults faults = validate_in_file_words(test_with(test.lab.test, values, 1)); !faults.empty()) return faults;
  }
  return {};
}

}  // namespace

Result<Study> study_from_json(json document, const std::filesystem::path& file, const StudyChanges& changes) {
  if (changes.of_study) changes.of_study(document);
  Faults found;
  Faults in_labs;
  Study study;
  if (has_format(document, "pastefit-study-1", found)) {
    ObjectReader reader(document, "", found);
    reader.known("format");
    reader.text("title", study.title, Need::required);
    study.tests = read_tests(reader, document, {file.parent_path(), changes.of_lab, in_labs});
    const ContactModel laws = read_contact(reader);
    for (StudyTest& test : study.tests) choose(laws, test.lab.test);
    study.parameters = read_parameters(reader, laws, study.tests);
    study.search.rejected_share = rejected_share_of_labs(study.tests, study.search.rejected_share);
    read_search(reader, static_cast<int>(std::max<std::size_t>(1, tests_of(study, false).size())), study.search);
  }
  if (found.empty() && in_labs.empty()) found = validate_points(study);
  Faults faults = in_file(std::move(found), file);
  faults.insert(faults.end(), in_labs.begin(), in_labs.end());
  if (!faults.empty()) return faults;
  study.content = document.dump();
  study.hash = content_hash(study.content);
  return study;
}

Result<Study> read_study(const std::filesystem::path& file, const StudyChanges& changes) {
  Faults faults;
  std::optional<json> document = read_json(file, faults);
  if (!document) return faults;
  Result<Study> study = study_from_json(std::move(*document), file, changes);
  if (study.ok() && faults.empty()) return study;
  if (!study.ok()) faults.insert(faults.end(), study.faults().begin(), study.faults().end());
  return faults;
}

}  // namespace pastefit
