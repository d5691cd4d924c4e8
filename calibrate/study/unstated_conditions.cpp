#include "calibrate/study/unstated_conditions.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "calibrate/base/units.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {
namespace {

using nlohmann::json;

json::json_pointer pointer_to(std::string field) {
  std::ranges::replace(field, '.', '/');
  return json::json_pointer("/" + field);
}

/// A number of the test's JSON, in SI, in the unit of its place in the files: "apparatus.lift_velocity_mm_s".
double in_unit_of_place(double value, std::string_view place) {
  const auto unit = unit_of_place(place);
  return unit && unit->key.starts_with("mm") ? mm * value : value;
}

Parameter& parameter_of(Study& study, const std::string& name) {
  return *std::ranges::find(study.parameters, name, &Parameter::name);
}

/// Sliding friction on the surfaces of a test, where the default is taken.
void add_frictions(Study& study, std::size_t test, std::vector<UnstatedCondition>& out) {
  for (const Surface& surface : surfaces_of(study.tests[test].lab.test)) {
    const Parameter& friction = parameter_of(study, std::string(surface.name) + "_friction");
    if (friction.free || friction.stated || friction.value <= 0) continue;
    const std::string place = "parameters." + friction.name;
    const auto known = std::ranges::find(out, place, &UnstatedCondition::place);
    if (known == out.end())
      out.push_back({place, friction.name, {test}, friction.value, true});
    else
      known->tests.push_back(test);
  }
}

}  // namespace

std::vector<UnstatedCondition> unstated_conditions(const Study& study) {
  std::vector<UnstatedCondition> out;
  Study copy = study;
  for (const std::size_t test : tests_of(study, false)) {
    const Lab& lab = study.tests[test].lab;
    for (const auto& [field, place] : often_unstated(lab.test)) {
      if (std::ranges::count(lab.stated, place) > 0) continue;
      const double value = to_json(lab.test).at(pointer_to(std::string(field))).get<double>();
      out.push_back(
          {reading_name(study.tests[test], place), std::string(field), {test}, in_unit_of_place(value, place), false});
    }
    add_frictions(copy, test, out);
  }
  return out;
}

Study with_condition(Study study, const UnstatedCondition& condition, double factor) {
  if (condition.parameter) {
    parameter_of(study, condition.field).value *= factor;
    return study;
  }
  for (const std::size_t test : condition.tests) {
    json document = to_json(study.tests[test].lab.test);
    json& value = document.at(pointer_to(condition.field));
    value = factor * value.get<double>();
    if (auto changed = test_from_json(document); changed.ok()) study.tests[test].lab.test = std::move(changed).value();
  }
  return study;
}

}  // namespace pastefit
