#include "calibrate/cli/scene.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "calibrate/base/json_reader.h"
#include "calibrate/card/card.h"
#include "calibrate/search/objective.h"
#include "calibrate/study/impact_json.h"
#include "calibrate/study/lab.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/rig.h"

namespace pastefit {

namespace {

using nlohmann::json;

struct Setting {
  std::string path;
  json value;
};

/// Settings of parameters stand apart: they are scale-free, which only a study's own file is.
struct Settings {
  std::vector<std::pair<std::size_t, double>> parameters;  // index in `parameter_kinds`, value
  std::vector<Setting> others;
};

constexpr std::string_view kParameters = "parameters.";

void read_parameter(const Setting& setting, Settings& settings, Faults& faults) {
  const auto kinds = parameter_kinds();
  const auto name = setting.path.substr(kParameters.size());
  const auto kind = std::ranges::find(kinds, name, &ParameterKind::name);
  const std::string where = "--set " + setting.path;
  if (kind == kinds.end()) {
    std::set<std::string, std::less<>> names;
    for (const auto& known : kinds) names.emplace(known.name);
    const auto near = nearest(name, names);
    faults.push_back({where, "there is no such parameter", near ? "did you mean \"" + *near + "\"?" : "see --help"});
    return;
  }
  const Range range{kind->smallest, kind->largest};
  const double value = setting.value.is_number() ? setting.value.get<double>() : 0;
  if (!setting.value.is_number() || !(value >= range.smallest && value <= range.largest))
    faults.push_back({where, "is " + setting.value.dump(), text_of(range)});
  else
    settings.parameters.emplace_back(static_cast<std::size_t>(kind - kinds.begin()), value);
}

Settings read_settings(const std::vector<std::string>& texts, Faults& faults) {
  Settings settings;
  for (const auto& text : texts) {
    const auto sign = text.find('=');
    if (sign == std::string::npos || sign == 0) {
      faults.push_back({"--set " + text, "is not path=value", "e.g. --set parameters.strength_pa=3000"});
      continue;
    }
    Setting setting{text.substr(0, sign), json::parse(text.substr(sign + 1), nullptr, false)};
    if (setting.value.is_discarded()) setting.value = text.substr(sign + 1);
    if (setting.path.starts_with(kParameters))
      read_parameter(setting, settings, faults);
    else
      settings.others.push_back(std::move(setting));
  }
  return settings;
}

/// Puts the value at its path; a key that the file's reader does not know is that reader's fault to report.
void apply(const Setting& setting, json& document, Faults& faults) {
  json* place = &document;
  std::string_view rest = setting.path;
  while (true) {
    const auto dot = rest.find('.');
    // Readings carry a dot in their name, "step1.height_mm": a key that is there as a whole wins.
    const bool whole = dot == std::string_view::npos || (place->is_object() && place->contains(rest));
    const std::string key(whole ? rest : rest.substr(0, dot));
    if (!place->is_object() || key.empty()) {
      faults.push_back(
          {"--set " + setting.path, "does not lead to a place in the file", "a path of keys, as in the file"});
      return;
    }
    place = &(*place)[key];
    if (whole) break;
    if (place->is_null()) *place = json::object();
    rest.remove_prefix(dot + 1);
  }
  *place = setting.value;
}

/// Reads the document with `from_json`, settings applied first.
template <class FromJson>
auto read_with(json document, const Settings& settings, const std::filesystem::path& file, Faults& faults,
               FromJson from_json) {
  for (const auto& setting : settings.others) apply(setting, document, faults);
  auto result = from_json(document);
  if (!result.ok())
    for (auto& fault : in_file(result.faults(), file)) faults.push_back(std::move(fault));
  return result;
}

Test with_parameters(const Test& test, std::vector<double> values, const Settings& settings, Faults& faults) {
  const ContactModel& laws = specimen_of(test).contact;
  for (const auto& [index, value] : settings.parameters) {
    const auto name = parameter_kinds()[index].name;
    if (!has_parameter(laws, name))
      faults.push_back(foreign_parameter(laws, "--set " + std::string(kParameters) + std::string(name), name));
    values[index] = value;
  }
  return with_contact_of(test, values);
}

std::optional<Test> study_scene(const json&, const Settings& settings, const std::filesystem::path& file,
                                Faults& faults) {
  const auto study = read_study(file);
  if (!study.ok()) {
    faults.insert(faults.end(), study.faults().begin(), study.faults().end());
    return std::nullopt;
  }
  auto test = study.value().tests.at(0).lab.test;
  if (!settings.others.empty()) {
    const auto lab_file = (file.parent_path() / study.value().tests[0].lab_file).lexically_normal();
    const auto lab = read_json(lab_file, faults);
    if (!lab) return std::nullopt;
    const auto changed = read_with(*lab, settings, lab_file, faults,
                                   [&](const json& content) { return lab_from_json(content, lab_file.parent_path()); });
    if (!changed.ok()) return std::nullopt;
    const auto contact = specimen_of(test).contact;  // the study's choice of laws
    test = changed.value().test;
    specimen_of(test).contact = contact;
  }
  const UnitPoint middle = UnitPoint::Constant(free_count(study.value()), 0.5);
  return with_parameters(test, values_at(study.value(), middle), settings, faults);
}

std::optional<Test> card_scene(const json& document, const Settings& settings, const std::filesystem::path& file,
                               Faults& faults) {
  const auto card = read_with(document, settings, file, faults, card_from_json);
  if (!card.ok()) return std::nullopt;
  if (settings.parameters.empty()) return card.value().test;
  std::vector<double> values;
  for (const auto& parameter : card.value().parameters) values.push_back(parameter.value);
  return with_parameters(card.value().test, std::move(values), settings, faults);
}

std::optional<Test> test_scene(const json& document, const Settings& settings, const std::filesystem::path& file,
                               Faults& faults) {
  const auto format = document.is_object() ? document.value("format", json()) : json();
  if (format == "pastefit-study-1") return study_scene(document, settings, file, faults);
  if (is_card(document)) return card_scene(document, settings, file, faults);
  if (format == "pastefit-lab-1") {
    const auto lab = read_with(document, settings, file, faults,
                               [&](const json& content) { return lab_from_json(content, file.parent_path()); });
    if (lab.ok()) return with_parameters(lab.value().test, usual_values(), settings, faults);
    return std::nullopt;
  }
  if (format == "pastefit-rig-1") {
    const auto rig = read_with(document, settings, file, faults, rig_from_json);
    if (rig.ok()) return with_parameters(rig.value().test, usual_values(), settings, faults);
    return std::nullopt;
  }
  faults.push_back({file.string() + ": format", "is " + format.dump(),
                    "\"pastefit-study-1\", a card (\"pastefit-card-1\" or later), \"pastefit-lab-1\", "
                    "\"pastefit-rig-1\" or \"pastefit-impact-1\""});
  return std::nullopt;
}

}  // namespace

Result<Scene> read_scene(const std::filesystem::path& file, const std::vector<std::string>& texts) {
  Faults faults;
  const auto settings = read_settings(texts, faults);
  const auto document = read_json(file, faults);
  if (!document) return faults;
  if (document->is_object() && document->value("format", json()) == "pastefit-impact-1") {
    if (!settings.parameters.empty())
      faults.push_back({"--set parameters.*", "an impact has none", "set its keys, e.g. contact.friction=0.3"});
    const auto impact = read_with(*document, settings, file, faults, impact_from_json);
    if (!faults.empty()) return faults;
    return Scene(impact.value());
  }
  const auto test = test_scene(*document, settings, file, faults);
  if (test && faults.empty()) faults = in_file(validate_in_file_words(*test), file);
  if (!faults.empty()) return faults;
  return Scene(*test);
}

}  // namespace pastefit
