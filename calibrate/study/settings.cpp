#include <algorithm>
#include <functional>
#include <regex>
#include <string_view>
#include <utility>

#include "calibrate/base/text.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

using nlohmann::json;

/// Place after one step of a path, "key" of an object or "key[1]" of a list in it; null if there is none.
json* step_into(json& place, const std::string& step) {
  if (!place.is_object() || step.empty()) return nullptr;
  const auto bracket = step.find('[');
  if (bracket == std::string::npos) return &place[step];
  const auto list = place.find(step.substr(0, bracket));
  if (!step.ends_with(']') || list == place.end() || !list->is_array()) return nullptr;
  const auto index = parsed_number<std::size_t>(step.substr(bracket + 1, step.size() - bracket - 2));
  return index && *index < list->size() ? &(*list)[*index] : nullptr;
}

/// Fault of a bound that the study does not have.
Fault no_such_bound(const std::string& path, const std::string& parameter) {
  if (std::ranges::count(parameter_kinds(), parameter, &ParameterKind::name) == 0)
    return no_such_parameter("--set " + path, parameter);
  return {"--set " + path, "is a bound of a parameter that is not free in the study",
          "--set 'parameters." + parameter + "={\"free\": [LOWER, UPPER]}'"};
}

/// Applies a setting of a study. The bounds of a parameter, `parameters.NAME.lower` and `.upper`, are a list in the
/// file.
void apply_to_study(Setting setting, json& study, Faults& faults) {
  static const std::regex bound(R"(parameters\.(\w+)\.(lower|upper))");
  std::smatch found;
  if (std::regex_match(std::as_const(setting.path), found, bound)) {
    const std::string name = found[1], path = "/parameters/" + name + "/free";
    const json::json_pointer place(path);
    if (!study.contains(place) || !study[place].is_array() || study[place].size() != 2) {
      faults.push_back(no_such_bound(setting.path, name));
      return;
    }
    setting.path = "parameters." + name + (found[2] == "lower" ? ".free[0]" : ".free[1]");
  }
  apply(setting, study, faults);
}

}  // namespace

Fault no_such_parameter(std::string where, std::string_view name) {
  return {std::move(where), "there is no such parameter",
          did_you_mean(name, names_of(parameter_kinds(), &ParameterKind::name),
                       "a name of the manual's page on parameters")};
}

std::vector<Setting> read_settings(const std::vector<std::string>& texts, Faults& faults) {
  std::vector<Setting> settings;
  for (const auto& text : texts) {
    const auto sign = text.find('=');
    if (sign == std::string::npos || sign == 0) {
      faults.push_back({"--set " + text, "is not path=value", "e.g. --set parameters.strength_pa=3000"});
      continue;
    }
    if (one_line(text) != text) {
      faults.push_back({"--set " + text, "holds a control character, or bytes that are no text", "plain UTF-8"});
      continue;
    }
    Setting setting{text.substr(0, sign), json::parse(text.substr(sign + 1), nullptr, false)};
    if (setting.value.is_discarded()) setting.value = text.substr(sign + 1);
    settings.push_back(std::move(setting));
  }
  return settings;
}

void apply(const Setting& setting, json& document, Faults& faults) {
  json* place = &document;
  std::string_view rest = setting.path;
  while (true) {
    const auto dot = rest.find('.');
    // Names of readings contain a dot, "step1.height_mm": an existing whole key takes precedence.
    const bool whole = dot == std::string_view::npos || (place->is_object() && place->contains(rest));
    place = step_into(*place, std::string(whole ? rest : rest.substr(0, dot)));
    if (!place) {
      faults.push_back({"--set " + setting.path, "does not lead to a place in the file",
                        "a path of keys, as in the file, e.g. tests[0].test.lift_velocity_m_s of a card"});
      return;
    }
    if (whole) break;
    if (place->is_null()) *place = json::object();
    rest.remove_prefix(dot + 1);
  }
  *place = setting.value;
}

Result<Study> read_study_with(const std::filesystem::path& file, const std::vector<std::string>& texts) {
  Faults faults;
  const std::vector<Setting> settings = read_settings(texts, faults);
  StudyChanges changes;
  changes.of_study = [&](json& study) {
    for (const Setting& setting : settings) apply_to_study(setting, study, faults);
  };
  std::optional<Study> study = value_or_append(read_study(file, changes), faults);
  if (!faults.empty()) return faults;
  study->settings = texts;
  return std::move(study).value();
}

}  // namespace pastefit
