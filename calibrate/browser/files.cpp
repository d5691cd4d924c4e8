#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "calibrate/base/refusal.h"
#include "calibrate/browser/calls.h"
#include "calibrate/exports/export.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/store/outcome_json.h"
#include "calibrate/store/program.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/slump_sheet.h"
#include "core/step/kernels.h"

namespace pastefit::browser {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json version() {
  return {{"version", program_version()},
          {"engine", program_identity()},
          {"kernels", kernels_of_this_processor().instruction_set}};
}

ordered_json presets() {
  ordered_json out = ordered_json::array();
  for (const std::string& name : preset_names(".")) {
    const auto preset = find_preset(name, ".");
    if (!preset.ok()) continue;
    const auto* const slump = std::get_if<SlumpTest>(&preset.value().test);
    const json content = json::parse(preset.value().content);
    out.push_back({{"name", name},
                   {"title", preset.value().title},
                   {"sheet", slump != nullptr},
                   {"drops", slump && slump->drop ? slump->drop->drops : 0},
                   {"caution", preset.value().caution},
                   {"apparatus", content.at("apparatus")}});
  }
  return out;
}

namespace {

/// A value as a person types it: a text, or a number.
std::string as_typed(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string as_typed(const json& request, const char* key, std::string without = "") {
  const auto found = request.find(key);
  return found == request.end() || found->is_null() ? std::move(without) : as_typed(*found);
}

Sheet::Named as_typed_by_name(const json& request, const char* key) {
  Sheet::Named out;
  if (const auto found = request.find(key); found != request.end())
    for (const auto& [name, value] : found->items()) out.emplace_back(name, as_typed(value));
  return out;
}

Sheet sheet_from(const json& request) {
  Sheet sheet;
  sheet.title = as_typed(request, "title", sheet.title);
  sheet.source = as_typed(request, "source");
  sheet.mould = as_typed(request, "mould");
  sheet.density = as_typed(request, "density");
  sheet.drops = request.value("drops", 0);
  for (const ShortReading& one : short_readings())
    if (const std::string values = as_typed(request, std::string(one.name).c_str()); !values.empty())
      sheet.readings.emplace_back(one.name, values);
  for (auto& one : as_typed_by_name(request, "reading")) sheet.readings.push_back(std::move(one));
  sheet.deviations = as_typed_by_name(request, "sd");
  sheet.grains = as_typed(request, "grains");
  sheet.yield_stress = as_typed(request, "yield_stress");
  sheet.target = as_typed(request, "for", sheet.target);
  sheet.law = as_typed(request, "law");
  sheet.fixed = as_typed_by_name(request, "fix");
  sheet.priors = as_typed_by_name(request, "prior");
  if (const auto places = request.find("confirm"); places != request.end())
    sheet.confirmed = places->get<std::vector<std::string>>();
  return sheet;
}

}  // namespace

ordered_json new_files(const json& request) {
  const StartingFiles files = value_or_throw(starting_files(sheet_from(request), "."));
  json study = json::parse(files.study, nullptr, true, true);
  study["lab"] = json::parse(files.lab, nullptr, true, true);
  const Study read = value_or_throw(study_from_json(std::move(study), "study.json"));
  ordered_json notes = ordered_json::array();
  for (const StudyTest& test : read.tests) {
    if (!test.lab.note.empty()) notes.push_back(test.lab.note);
    for (const std::string& note : test.lab.notes) notes.push_back(note);
  }
  return {{"lab", files.lab}, {"study", files.study}, {"notes", notes}};
}

ordered_json exported(const json& request) {
  Faults faults;
  const auto exporter = exporter_named(request.at("target").get<std::string>());
  append(faults, exporter);
  std::optional<Card> card;
  if (const auto document = parse_json(request.at("card").get<std::string>(), faults)) {
    auto read = card_from_json(*document);
    append(faults, read);
    if (read.ok()) card = std::move(read).value();
  }
  refuse(faults);
  const Export written = value_or_throw(export_card(
      *card, exporter.value(),
      {"card.json", request.value("test", std::string()), std::nullopt, request.value("unconfirmed", false), {}}));
  ordered_json files = ordered_json::array();
  for (const ExportFile& file : written.files) files.push_back({{"name", file.name}, {"text", file.content}});
  return {{"files", files}, {"notes", written.notes}};
}

}  // namespace pastefit::browser
