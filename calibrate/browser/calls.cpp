#include <exception>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "calibrate/base/refusal.h"
#include "calibrate/browser/calibration_session.h"
#include "calibrate/evaluate/simulation.h"
#include "calibrate/exports/export.h"
#include "calibrate/laboratory/test.h"
#include "calibrate/store/program.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/slump_sheet.h"
#include "core/step/kernels.h"

namespace pastefit::browser {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

// What a page in a browser calls: a name and a request in JSON, an answer in JSON. Each function throws `Refusal` for
// input that it cannot use, and nlohmann::json::exception for a request of another form.

/// {"version", "engine", "kernels"}
ordered_json version(const json&) {
  return {{"version", program_version()},
          {"engine", program_identity()},
          {"kernels", kernels_of_this_processor().instruction_set}};
}

/// Moulds that a sheet may name: [{"name", "title", "sheet", "drops", "caution", "apparatus"}, ...]
ordered_json presets(const json&) {
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

/// The starting files of a sheet, {"lab", "study", "notes"}, from the options of `pastefit new` as keys: "mould",
/// "density", "slump", "spread", ..., "sd", "fix" and "prior" as objects of texts, "confirm" as a list.
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

/// {"files": [{"name", "text"}, ...], "notes"} of {"card", "target", "test", "unconfirmed"}: as `pastefit export`.
ordered_json exported(const json& request) {
  Faults faults;
  const auto exporter = value_or_append(exporter_named(request.at("target").get<std::string>()), faults);
  std::optional<Card> card;
  if (const auto document = parse_json(request.at("card").get<std::string>(), faults))
    card = value_or_append(card_from_json(*document), faults);
  refuse(faults);
  const Export written = value_or_throw(export_card(
      *card, exporter.value(),
      {"card.json", request.value("test", std::string()), std::nullopt, request.value("unconfirmed", false), {}}));
  ordered_json files = ordered_json::array();
  for (const ExportFile& file : written.files) files.push_back({{"name", file.name}, {"text", file.content}});
  return {{"files", files}, {"notes", written.notes}};
}

std::unique_ptr<CalibrationSession>& session() {
  static std::unique_ptr<CalibrationSession> one;
  return one;
}

CalibrationSession& open_session() {
  if (!session()) refuse({{"session", "no calibration is open", "call \"open\" first"}});
  return *session();
}

ordered_json open(const json& request) {
  session().reset();
  session() = std::make_unique<CalibrationSession>(request);
  return session()->description();
}

ordered_json result(const json&) {
  if (!open_session().progress().at("finished").get<bool>())
    refuse({{"session", "the calibration has not finished", "go on with \"suggest\" and \"ingest\", or \"stop\""}});
  return open_session().result();
}

ordered_json stop(const json&) {
  open_session().stop();
  return ordered_json::object();
}

ordered_json simulated(const json& request) {
  const auto task = request.at("task").get<std::string>();
  std::string answer;
  try {
    answer = simulate_task(task);
  } catch (const std::exception& error) {
    answer = failed_task(error.what());
  }
  const auto sketch = json::parse(answer).value("sketch", json());
  return {{"answer", answer}, {"outline", sketch}};
}

using Call = ordered_json (*)(const json& request);

const std::map<std::string_view, Call>& calls() {
  static const std::map<std::string_view, Call> all{
      {"version", version},
      {"presets", presets},
      {"new", new_files},
      {"export", exported},
      {"simulate", simulated},
      {"open", open},
      {"suggest", [](const json& request) { return open_session().suggest(request.at("count").get<std::size_t>()); }},
      {"ingest", [](const json& request) { return open_session().ingest(request); }},
      {"progress", [](const json&) { return open_session().progress(); }},
      {"stop", stop},
      {"result", result}};
  return all;
}

ordered_json faults_json(const Faults& faults) {
  ordered_json out = ordered_json::array();
  for (const Fault& fault : faults)
    out.push_back({{"where", fault.where}, {"what", fault.what}, {"remedy", fault.remedy}});
  return {{"faults", out}};
}

/// The answer to a call: {"ok": ANSWER} or {"faults": [{"where", "what", "remedy"}, ...]}, as text. The module holds
/// one calibration at most, from "open" on. Throws nothing.
std::string answer_to_call(const std::string& name, const std::string& request) {
  const auto text = [](const ordered_json& answer) {
    return answer.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  };
  try {
    const auto call = calls().find(name);
    if (call == calls().end())
      return text(faults_json({{name, "is no call of the module", "one of calibrate/browser/calls.cpp"}}));
    return text({{"ok", call->second(json::parse(request))}});
  } catch (const Refusal& refusal) {
    return text(faults_json(refusal.faults));
  } catch (const std::exception& error) {
    return text(faults_json({{name, error.what(), "this is an error of the program; report it"}}));
  }
}

}  // namespace

}  // namespace pastefit::browser

/// Answers a call of the page. The text lives until the next call.
extern "C" const char* pastefit_call(const char* name, const char* request) {
  static std::string answer;
  answer = pastefit::browser::answer_to_call(name, request);
  return answer.c_str();
}
