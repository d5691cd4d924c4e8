#include "calibrate/study/study.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/schemas.h"
#include "calibrate/study/tests.h"
#include "core/laws/table.h"

namespace pastefit {
namespace {

using nlohmann::json;

void read_parameter(ObjectReader& reader, const ParameterKind& kind, Parameter& parameter) {
  const Range range{kind.smallest, kind.largest};
  if (!reader.has("free")) {
    reader.number("value", parameter.value, range, Need::required);
    reader.refuse("scale", "a fixed parameter has no scale", "leave it out, or give \"free\": [lower, upper]");
    reader.refuse("prior", "a fixed parameter is known already", "leave it out, or give \"free\": [lower, upper]");
    return;
  }
  read_free(reader, range, parameter);
}

void describe_choice(auto& fields, ContactModel& laws) {
  const Need optional = Need::optional;
  fields.choice({"normal", "force law of overlapping grains; default hertz", "laws.schema.json#/properties/normal"},
                laws.normal, normal_laws, optional);
  fields.choice({"attraction", "law of the attraction across a gap; default polynomial",
                 "laws.schema.json#/properties/attraction"},
                laws.bridge.shape, bridge_shapes, optional);
  fields.choice({"formation",
                 "event that forms a liquid bridge; film: the liquid shells of two grains touch; touch: the grains "
                 "themselves touch; default film"},
                laws.bridge.formation, bridge_formations, optional);
  fields.choice({"rolling_model", "law of the rolling resistance; default spring_dashpot",
                 "laws.schema.json#/properties/rolling"},
                laws.rolling, rolling_models, optional);
  fields.choice(
      {"friction_basis",
       "normal force in the friction limit; elastic: the repulsion alone, so that cohesion increases friction; total: "
       "the whole normal force plus twice the largest attraction, as in LAMMPS; net: the whole normal force, so that "
       "grains in equilibrium between attraction and repulsion have no friction; default elastic"},
      laws.friction_basis, friction_bases, optional);
}

ContactModel read_contact(ObjectReader& document) {
  ContactModel laws;
  laws.bridge.shape = BridgeShape::polynomial;
  document.object("contact", Need::optional, [&](ObjectReader& reader) {
    describe_choice(reader, laws);
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
  std::vector<Parameter> parameters = default_parameters();
  document.object("parameters", Need::required, [&](ObjectReader& reader) {
    bool any_free = false;
    reader.refuse("offset_ratio", "is a key of earlier programs",
                  "\"formation_ratio\": 2 offset_ratio/rupture_gap_ratio, at most 1; free: {\"free\": [0, 1]}");
    for (Parameter& parameter : parameters) {
      const ParameterKind& kind = parameter_kinds()[static_cast<std::size_t>(&parameter - parameters.data())];
      reader.object(kind.name, Need::optional, [&](ObjectReader& one) { read_parameter(one, kind, parameter); });
      if (reader.has(kind.name) && !has_parameter(laws, kind.name))
        reader.faults().push_back(foreign_parameter(laws, reader.place(kind.name), kind.name));
      else if (reader.has(kind.name) && std::ranges::none_of(tests, [&](const StudyTest& test) {
                 return test.lab.measurements.empty() || acts_in(test.lab.test, kind.name);  // or it could not be read
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

/// The accepted share of sheared-off heaps is at least the measured one.
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

/// Corner of the unit cube: one parameter at an end of its bounds, the other free ones at the other end.
std::vector<double> corner(const Study& study, std::string_view name, double end) {
  std::vector<double> point;
  for (const Parameter& parameter : study.parameters)
    if (parameter.free) point.push_back(parameter.name == name ? end : 1 - end);
  return point;
}

/// Validates the tests at the centre and at corners of the bounds: every point must be runnable.
Faults validate_points(const Study& study) {
  const auto free = static_cast<std::size_t>(free_count(study));
  using Point = std::vector<double>;
  const Point largest_overlaps = corner(study, "youngs_modulus_pa", 0);
  std::vector<Point> points{Point(free, 0.5), Point(free, 0.0), Point(free, 1.0), largest_overlaps};
  const auto is_viscosity = [](const Parameter& one) { return one.free && one.name == "viscosity_pa_s"; };
  if (std::ranges::any_of(study.parameters, is_viscosity))  // the softest grains in the most viscous liquid
    points.insert(points.begin(), corner(study, "viscosity_pa_s", 1));
  for (const Point& point : points) {
    const std::vector<double> values = values_at(study, point);
    for (const StudyTest& test : study.tests)
      if (Faults faults = validate_in_file_words(test_with(test.lab.test, values, 1)); !faults.empty()) return faults;
  }
  return {};
}

}  // namespace

std::vector<Parameter> default_parameters() {
  std::vector<Parameter> parameters;
  for (const ParameterKind& kind : parameter_kinds())
    parameters.push_back({std::string(kind.name), false, kind.default_value, 0, 0, kind.scale});
  return parameters;
}

Result<Study> study_from_json(json document, const std::filesystem::path& file, const StudyChanges& changes) {
  if (changes.of_study) changes.of_study(document);
  Faults in_labs;
  Study study;
  Faults found = read_document(document, "pastefit-study-1", [&](ObjectReader& reader) {
    reader.text("title", study.title, Need::required);
    study.tests = read_tests(reader, {file.parent_path(), changes.of_lab, in_labs});
    const ContactModel laws = read_contact(reader);
    for (StudyTest& test : study.tests) choose(laws, test.lab.test);
    study.parameters = read_parameters(reader, laws, study.tests);
    study.search.rejected_share = rejected_share_of_labs(study.tests, study.search.rejected_share);
    read_search_options(reader, static_cast<int>(std::max<std::size_t>(1, tests_of(study, false).size())),
                        study.search);
  });
  if (found.empty() && in_labs.empty()) found = validate_points(study);
  Faults faults = in_file(std::move(found), file);
  append(faults, std::move(in_labs));
  if (!faults.empty()) return faults;
  study.content = document.dump();
  study.hash = content_hash(study.content);
  return study;
}

Result<Study> read_study(const std::filesystem::path& file, const StudyChanges& changes) {
  Faults faults;
  std::optional<json> document = read_json(file, faults);
  if (!document) return faults;
  std::optional<Study> study = value_or_append(study_from_json(std::move(*document), file, changes), faults);
  if (!faults.empty()) return faults;
  return std::move(study).value();
}

ObjectSchema::Json study_schema() {
  using Json = ObjectSchema::Json;
  ObjectSchema schema("pastefit-study-1");
  schema.text({"title", "title, one line"}, "", Need::required);
  tell_tests(schema);
  ContactModel any;
  schema.object({"contact", "contact laws; data/README.md describes them"}, Need::optional,
                [&](ObjectSchema& fields) { describe_choice(fields, any); });
  Json parameters = schema.described([](ObjectSchema& fields) {
    for (const ParameterKind& kind : parameter_kinds()) tell_parameter(fields, kind);
  });
  parameters["minProperties"] = 1;
  schema.put({"parameters",
              "Parameters of the contact laws. A fixed parameter is {`value`: NUMBER}. A fitted parameter is {`free`: "
              "[LOWER, UPPER], `scale`: \"linear\" or \"log\", `prior`: {`value`, `standard_deviation`}}, where LOWER "
              "and UPPER are its bounds; `scale` and `prior` are optional. A parameter that is not named has its "
              "default value. A prior is a normal distribution. On a log scale, it is the normal distribution of the "
              "logarithm, and standard_deviation/value is its standard deviation."},
             std::move(parameters), Need::required);
  tell_search_options(schema);
  const auto needed = [](const char* key) {
    Json schema_of_key;
    schema_of_key["required"].push_back(key);
    return schema_of_key;
  };
  Json one_test = needed("lab"), several = needed("tests");
  one_test["not"] = needed("tests");
  for (const char* key : {"lab", "weights", "tolerances"}) several["not"]["anyOf"].push_back(needed(key));
  for (const Json& form : {one_test, several}) schema.described()["oneOf"].push_back(form);
  return schema.document(
      "pastefit study file",
      "A study gives the parameters to fit, the measurements of one or several laboratory files to which they are "
      "fitted, and the options of the search. The program also checks rules that the schema does not contain. The "
      "lower bound of a parameter must be below its upper bound, and the two must differ by more than a millionth of "
      "the larger absolute value. On a log scale, they may differ by at most a factor of 1e12. At least one parameter "
      "must be free. Every parameter that the study names must belong to one of its contact laws.");
}

ObjectSchema::Json laws_schema() {
  ObjectSchema schema;
  schema.choice({"normal",
                 "force law of overlapping grains; hertz: elastic spheres; jkr: elastic spheres that adhere; dmt: "
                 "stiff spheres that adhere; sjkr: attraction proportional to the contact area of the spheres; epa: "
                 "elasto-plastic spheres that adhere (EEPA); luding: like epa, but with linear springs"},
                NormalLaw(), normal_laws, Need::optional);
  schema.choice({"attraction",
                 "attraction across a gap, where -d is the gap and -d_c the rupture gap; polynomial: a d^2 + b d + c "
                 "for d_c <= d <= 0; linear: decreases to zero at d_c; exponential: c exp(-3 d/d_c); capillary: a "
                 "liquid bridge of given volume"},
                BridgeShape(), bridge_shapes, Need::optional);
  schema.choice({"rolling",
                 "rolling resistance; spring_dashpot: an elastic-plastic spring with a dashpot; constant_torque: a "
                 "constant torque against the spin"},
                RollingModel(), rolling_models, Need::optional);
  return schema.document(
      "pastefit contact laws",
      "Names of the contact laws in studies, cards and cases. core/laws/README.md describes the laws.");
}

}  // namespace pastefit
