#include "calibrate/card/scene.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/card/card.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/impact_json.h"
#include "calibrate/study/lab.h"
#include "calibrate/study/parameters.h"
#include "calibrate/study/study.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

using nlohmann::json;

/// Settings of parameters are separate, because they are scale-free; of all files only a study is.
struct SceneSettings {
  std::vector<std::pair<std::size_t, double>> parameters;  // index in `parameter_kinds`, value
  std::vector<Setting> others;
};

constexpr std::string_view kParameters = "parameters.";

void read_parameter(const Setting& setting, SceneSettings& settings, Faults& faults) {
  const auto kinds = parameter_kinds();
  const auto name = setting.path.substr(kParameters.size());
  const auto kind = std::ranges::find(kinds, name, &ParameterKind::name);
  const std::string where = "--set " + setting.path;
  if (kind == kinds.end()) return faults.push_back(no_such_parameter(where, name));
  const Range range{kind->smallest, kind->largest};
  const double value = setting.value.is_number() ? setting.value.get<double>() : 0;
  if (!setting.value.is_number() || !(value >= range.smallest && value <= range.largest))
    faults.push_back({where, "is " + text_of(setting.value), text_of(range)});
  else
    settings.parameters.emplace_back(static_cast<std::size_t>(kind - kinds.begin()), value);
}

SceneSettings read_scene_settings(const std::vector<std::string>& texts, Faults& faults) {
  SceneSettings settings;
  for (Setting& setting : read_settings(texts, faults)) {
    // Parameters may be given by name alone.
    if (std::ranges::find(parameter_kinds(), setting.path, &ParameterKind::name) != parameter_kinds().end())
      setting.path.insert(0, kParameters);
    if (setting.path.starts_with(kParameters))
      read_parameter(setting, settings, faults);
    else
      settings.others.push_back(std::move(setting));
  }
  return settings;
}

/// A single word that is neither a parameter nor a section of a file is an error, mostly a misspelt parameter. It is
/// reported and removed, so that all other faults are found, too.
void take_out_slips(SceneSettings& settings, const json& document, Faults& faults) {
  Names known = names_of(parameter_kinds(), &ParameterKind::name);
  known.insert({"title", "test", "provenance", "apparatus", "material", "grains", "measurements", "confirmed"});
  std::erase_if(settings.others, [&](const Setting& setting) {
    const std::string& word = setting.path;
    if (word.find_first_of(".[") != std::string::npos || known.contains(word) ||
        (document.is_object() && document.contains(word)))
      return false;
    faults.push_back({"--set " + printable(word), "is neither a parameter nor a section of the file",
                      did_you_mean(word, known, "e.g. --set friction=0.3 or grains.radius_mm=6")});
    return true;
  });
}

/// Reads the document with `from_json`, settings applied first.
auto read_with(json document, const SceneSettings& settings, const std::filesystem::path& file, Faults& faults,
               auto from_json) {
  for (const auto& setting : settings.others) apply(setting, document, faults);
  auto result = from_json(document);
  if (!result.ok()) append(faults, in_file(result.faults(), file));
  return result;
}

Test with_parameters(const Test& test, std::vector<double> values, const SceneSettings& settings, Faults& faults) {
  const ContactModel& laws = specimen_of(test).contact;
  for (const auto& [index, value] : settings.parameters) {
    const auto name = parameter_kinds()[index].name;
    if (!has_parameter(laws, name))
      faults.push_back(foreign_parameter(laws, "--set " + std::string(kParameters) + std::string(name), name));
    else if (!acts_in(test, name))
      faults.push_back(surface_of_no_test("--set " + std::string(kParameters) + std::string(name), name));
    values[index] = value;
  }
  return with_contact_of(test, values);
}

/// Index of the test with this name, of the first one if empty; none, and a fault, if there is none.
std::optional<std::size_t> chosen(const auto& tests, const std::string& name, Faults& faults) {
  if (name.empty()) return 0;
  return value_or_append(place_of_test(tests, name), faults);
}

/// Notes on a laboratory file for the user.
std::vector<std::string> notes_of(const Lab& lab) {
  std::vector<std::string> notes = lab.notes;
  if (!lab.note.empty()) notes.insert(notes.begin(), lab.note);
  for (std::string& note : check_readings(lab.test, lab.measurements).remarks()) notes.push_back(std::move(note));
  return notes;
}

/// True if the path belongs to the study; others belong to its laboratory file.
bool is_of_study(const Setting& setting) {
  constexpr std::array<std::string_view, 5> own{"contact", "search", "weights", "tolerances", "tests"};
  const std::string_view first = std::string_view(setting.path).substr(0, setting.path.find_first_of(".["));
  return std::ranges::count(own, first) > 0;
}

/// As all that follow, adds a fault if there is no such scene; the result is then of no use.
FoundScene study_scene(const json& document, const SceneSettings& settings, const std::string& name,
                       const std::filesystem::path& file, Faults& faults) {
  bool changed = false;
  StudyChanges changes;
  changes.of_study = [&](json& study) {
    for (const auto& setting : settings.others)
      if (is_of_study(setting)) apply(setting, study, faults);
  };
  changes.of_lab = [&](json& lab, const StudyTest& test) {
    if (changed || (name.empty() ? test.hold_out : test.name != name)) return;
    changed = true;
    for (const auto& setting : settings.others)
      if (!is_of_study(setting)) apply(setting, lab, faults);
  };
  const auto study = value_or_append(study_from_json(document, file, changes), faults);
  if (!study) return {};
  const auto place = chosen(study.value().tests, name, faults);
  if (!place) return {};
  const Lab& lab = study.value().tests[*place].lab;
  const std::vector<double> middle(static_cast<std::size_t>(free_count(study.value())), 0.5);
  return {with_parameters(lab.test, values_at(study.value(), middle), settings, faults), notes_of(lab)};
}

FoundScene card_scene(const json& document, const SceneSettings& settings, const std::string& name,
                      const std::filesystem::path& file, Faults& faults) {
  const auto card = read_with(document, settings, file, faults, card_from_json);
  if (!card.ok()) return {};
  const auto place = chosen(card.value().tests, name, faults);
  if (!place) return {};
  const Test& test = card.value().tests[*place].test;
  if (settings.parameters.empty()) return {test, {}};
  return {with_parameters(test, values_of(card.value().material), settings, faults), {}};
}

FoundScene test_scene(const json& document, const SceneSettings& settings, const std::string& name,
                      const std::filesystem::path& file, Faults& faults) {
  const auto format = document.is_object() ? document.value("format", json()) : json();
  if (format == "pastefit-study-1") return study_scene(document, settings, name, file, faults);
  if (is_card(document)) return card_scene(document, settings, name, file, faults);
  if (!name.empty()) faults.push_back({"--test", "only studies and cards have several tests", "leave it out"});
  if (format == "pastefit-lab-1") {
    const auto lab = read_with(document, settings, file, faults,
                               [&](const json& content) { return lab_from_json(content, file.parent_path()); });
    if (!lab.ok()) return {};
    return {with_parameters(lab.value().test, default_values(), settings, faults), notes_of(lab.value())};
  }
  if (format == "pastefit-rig-1") {
    const auto apparatus = read_with(document, settings, file, faults, apparatus_from_json);
    if (!apparatus.ok()) return {};
    FoundScene found{with_parameters(apparatus.value().test, default_values(), settings, faults), {}};
    if (!apparatus.value().caution.empty()) found.notes.push_back(apparatus.value().caution);
    return found;
  }
  faults.push_back({file.string() + ": format", "is " + format.dump(),
                    "\"pastefit-study-1\", a card (\"pastefit-card-6\"), \"pastefit-lab-1\", "
                    "\"pastefit-rig-1\" or \"pastefit-impact-1\""});
  return {};
}

}  // namespace

Result<FoundScene> scene_from_json(const json& document, const std::filesystem::path& file,
                                   const std::vector<std::string>& texts, const std::string& name) {
  Faults faults;
  auto settings = read_scene_settings(texts, faults);
  if (document.is_object() && document.value("format", json()) == "pastefit-impact-1") {
    if (!settings.parameters.empty())
      faults.push_back({"--set parameters.*", "an impact has none", "set its keys, e.g. contact.friction=0.3"});
    if (!name.empty()) faults.push_back({"--test", "only studies and cards have several tests", "leave it out"});
    const auto impact = read_with(document, settings, file, faults, impact_from_json);
    if (!faults.empty()) return faults;
    return FoundScene{impact.value(), {}};
  }
  take_out_slips(settings, document, faults);
  FoundScene found = test_scene(document, settings, name, file, faults);
  if (faults.empty()) faults = in_file(validate_in_file_words(std::get<Test>(found.scene)), file);
  if (!faults.empty()) return faults;
  return found;
}

Result<FoundScene> read_scene(const std::filesystem::path& file, const std::vector<std::string>& texts,
                              const std::string& name) {
  Faults faults, unread;
  const auto document = read_json(file, unread);
  if (!document) (void)read_scene_settings(texts, faults);
  append(faults, std::move(unread));
  if (!document) return faults;
  auto found = value_or_append(scene_from_json(*document, file, texts, name), faults);
  if (!faults.empty()) return faults;
  return std::move(found).value();
}

Outcome simulate(const Scene& scene, const RunOptions& options) {
  return std::visit([&](const auto& test) { return simulate(test, options); }, scene);
}

}  // namespace pastefit
