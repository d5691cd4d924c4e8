#include "calibrate/study/unstated_conditions.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "calibrate/study/parameters.h"
#include "calibrate/study/tests.h"

namespace pastefit {
namespace {

using nlohmann::json;

Parameter& parameter_of(Study& study, const std::string& name) {
  return *std::ranges::find(study.parameters, name, &Parameter::name);
}

/// Adds the sliding friction of surfaces for which the default is used.
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
    for (const FilePlace& one : places_in_files(lab.test)) {
      if (!one.often_unstated || std::ranges::count(lab.stated, one.place) > 0) continue;
      const double in_si = to_json(lab.test).at(pointer_to(one.field)).get<double>();
      out.push_back(
          {reading_name(study.tests[test], one.place), one.field, {test}, in_si * file_key(one.field).per_si, false});
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
