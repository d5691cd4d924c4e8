#include "calibrate/study/slump_sheet.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/slump.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/lab.h"
#include "core/apparatus/reading_kind.h"

namespace pastefit {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::array<ShortReading, 13> shorts{{
    {"slump", "step1.slump_mm", "height of the mould minus that of the heap"},
    {"height", "step1.height_mm", "height of the heap"},
    {"spread", "step1.spread_mm", "width of the heap"},
    {"shift", "step1.lateral_shift_mm", "sideways shift of the top's centre"},
    {"angle", "step1.angle_of_repose_deg", "angle of repose of a dry material"},
    {"height2", "step2.height_mm", "height after the first drop"},
    {"slump2", "step2.slump_mm", "slump after the first drop"},
    {"spread2", "step2.spread_mm", "width after the first drop"},
    {"sag", "step2.plateau_sag_mm", "height difference of the top, positive if the free side is lower"},
    {"flow", "after_drops.spread_mm", "width of the heap after all drops"},
    {"height-after", "after_drops.height_mm", "height after all drops"},
    {"slide-angle", "tilt.slide_angle_deg", "inclination of the table at which the heap slides"},
    {"mass", "fill.mass_kg", "mass of the mould's content"},
}};

std::string_view key_of_reading(std::string_view name) {
  const auto found = std::ranges::find(shorts, name, &ShortReading::name);
  return found == shorts.end() ? name : found->key;
}

std::string reading_fault_place(std::string_view name) {
  return "reading " + printable(name);
}

/// Base, top and height of a mould [mm] from "200/100/300" or "8/4/12 in"; nothing for other texts.
std::optional<std::vector<double>> lengths_in(std::string mould) {
  const bool three = std::ranges::count(mould, '/') == 2;
  std::ranges::replace(mould, '/', ';');
  const auto read = written_readings("mould", mould, "mm");
  return three && read.ok() && read.value().size() == 3 ? std::optional(read.value()) : std::nullopt;
}

/// Apparatus for a custom mould: a table large enough for the heap, a lift of 3 s but at least 50 mm/s.
ordered_json own_apparatus(const std::vector<double>& mould) {
  const double base = mould[0], top = mould[1], height = mould[2];
  const double wider = std::max(base, top);
  return {{"mould", {{"base_diameter_mm", base}, {"top_diameter_mm", top}, {"height_mm", height}}},
          {"table_length_mm", rounded(std::max(4.5 * wider, 3 * height), 3)},
          {"lift_velocity_mm_s", rounded(std::max(height / 3, 50.0), 3)},
          {"drop_plate", nullptr},
          {"reading", {{"height", "axis"}, {"probe_diameter_mm", rounded(wider / 5, 3)}}}};
}

/// "apparatus" of a laboratory file.
ordered_json apparatus_json(const std::string& mould, const std::filesystem::path& folder) {
  if (const auto own = lengths_in(mould)) return own_apparatus(*own);
  return {{"preset", preset_of_standard(mould, folder)}};
}

/// Adds the sheet's drops, and a table large enough for the heap; the preset's table size is an assumption.
ordered_json apparatus_json(const Sheet& sheet, const std::filesystem::path& folder, const SlumpTest& test,
                            const ordered_json& measurements) {
  constexpr double room = 1.3;
  ordered_json out = apparatus_json(sheet.mould, folder);
  if (sheet.drops > 0) out["drop_plate"] = {{"drops", sheet.drops}};
  const auto spread = measurements.find("step1.spread_mm");
  if (test.drop || spread == measurements.end()) return out;
  const double widest_mm = spread->contains("value")
                               ? spread->at("value").get<double>()
                               : std::ranges::max(spread->at("repeats").get<std::vector<double>>());
  if (widest_mm > mm * test.table_length_m) out["table_length_mm"] = rounded(room * widest_mm, 2);
  return out;
}

const SlumpTest& slump_of(const Test& test) {
  return std::get<SlumpTest>(test);
}

/// Radii within 25 % of the preset's mean: equal spheres form layers and shear off along them. For custom moulds, and
/// presets with too few grains, as many grains as an Abrams cone has with 8 mm.
ordered_json grains_json(const Test& test, bool preset) {
  constexpr double many = 1600, too_few = 500;
  constexpr double largest_of_opening = 0.08;
  const double opening_mm = 1e3 * *narrowest_opening_m(slump_of(test));
  const double preset_mm = 1e3 * specimen_of(test).grains.radius_m, count = grains_needed(test);
  const double of_many_mm = preset_mm * std::cbrt(count / many);
  const double radius_mm =
      preset && count >= too_few ? preset_mm : std::min(of_many_mm, largest_of_opening * opening_mm);
  return {{"distribution", "uniform"},
          {"smallest_mm", rounded(0.75 * radius_mm, 3)},
          {"largest_mm", rounded(1.25 * radius_mm, 3)}};
}

/// Grains of the sheet; default: those of the mould.
ordered_json grains_json(const Sheet& sheet, const Test& test, Faults& faults) {
  if (sheet.grains.empty()) return grains_json(test, !lengths_in(sheet.mould));
  const auto radii = value_or_append(written_readings("grains", sheet.grains, "mm"), faults);
  if (!radii) return {};
  if (radii->size() == 1) return {{"distribution", "mono"}, {"radius_mm", radii->at(0)}};
  if (radii->size() == 2)
    return {{"distribution", "uniform"}, {"smallest_mm", radii->at(0)}, {"largest_mm", radii->at(1)}};
  faults.push_back({"grains", "are " + std::to_string(radii->size()) + " numbers",
                    "their radius, \"8\", or the smallest and the largest, \"6, 10\""});
  return {};
}

/// Standard deviation of a single reading: the published one for this mould, otherwise a fraction of the mould's
/// height, or of a mass. Angle of repose: nothing is published; 1.5 degrees is the value of wheat calibrations
/// (data/lab/wheat-repose.json). Times: EN 12350-8 gives a repeatability of 0.66 s, which is 2.8 deviations; a tenth of
/// longer times.
double deviation_of(const ReadingKind& kind, const Test& test, double value) {
  constexpr double share_of_mass = 0.01, share_of_height = 0.025, of_angle_deg = 1.5;
  constexpr double of_time_s = 0.66 / 2.8, share_of_time = 0.1;
  if (kind.key.ends_with("_s")) return rounded(std::max(of_time_s, share_of_time * value), 2);
  if (kind.published_deviation > 0) return rounded(kind.published_deviation, 2);
  if (kind.key.ends_with("_deg")) return of_angle_deg;
  if (kind.key == "fill.mass_kg") return rounded(share_of_mass * value, 2);
  return rounded(share_of_height * 1e3 * slump_of(test).mould.height_m, 2);
}

ordered_json reading_json(const std::vector<double>& values, double deviation) {
  ordered_json out;
  if (values.size() == 1)
    out["value"] = values[0];
  else
    out["repeats"] = values;
  out["standard_deviation"] = deviation;
  return out;
}

/// Appends a sentence to the notes of the file's provenance.
void add_note(ordered_json& lab, const std::string& note) {
  std::string notes = lab["provenance"].value("notes", "");
  lab["provenance"]["notes"] = notes + (notes.empty() ? "" : "; ") + note;
}

/// Flow after the drops of a table [mm]; the text may be in per cent of the mould's base.
Result<std::vector<double>> flow_mm(const std::string& where, const std::string& typed, const SlumpTest& test) {
  const std::string text = with_percent_sign(typed);
  const auto of_percent = [&](double percent) { return rounded(width_of_flow_mm(test, percent), 6); };
  if (text.find('%') == std::string::npos) {
    auto lengths = written_readings(where, text, "mm");
    const bool unit = std::ranges::any_of(text, [](unsigned char letter) { return std::isalpha(letter) != 0; });
    if (!lengths.ok() || unit || !gives_flow_in_percent(test)) return lengths;
    const std::string one = shown(lengths.value()[0]);
    return Fault{
        where, "has no unit, and ASTM C1437 gives a flow in per cent of the mould's base",
        "\"" + one + " %\", which is " + shown(of_percent(lengths.value()[0])) + " mm wide, or \"" + one + " mm\""};
  }
  std::string bare = text;
  std::erase(bare, '%');
  auto percents = written_readings(where, bare, "");
  if (!percents.ok()) return percents;
  std::vector<double> out;
  for (const double percent : percents.value()) out.push_back(of_percent(percent));
  return out;
}

Result<std::vector<double>> values_of_reading(const std::string& name, const std::string& text, std::string_view key,
                                              const SlumpTest& test) {
  if (key == "after_drops.spread_mm") return flow_mm(reading_fault_place(name), text, test);
  const auto unit = unit_of_key(key);
  return written_readings(reading_fault_place(name), text, unit ? unit->key : "");
}

/// Standard deviation of a reading that the sheet gives, if any.
std::optional<double> deviation_in(const Sheet& sheet, std::string_view key, Faults& faults) {
  for (const auto& [name, text] : sheet.deviations) {
    if (key_of_reading(name) != key) continue;
    const auto unit = unit_of_key(key);
    const auto read = written_readings("sd " + printable(name), text, unit ? unit->key : "");
    if (read.ok() && read.value().size() == 1 && read.value()[0] > 0) return read.value()[0];
    faults.push_back({"sd " + printable(name), "is " + in_quotes(text), "one number above 0, in the reading's unit"});
  }
  return std::nullopt;
}

/// Suggestion for an unknown reading name: a reading whose key ends with it, or with a similar spelling.
std::optional<std::string> meant_reading(std::string_view name, std::span<const ReadingKind> of_test) {
  const std::string end = "." + small_letters(name);
  for (const ReadingKind& kind : of_test)
    if (!kind.from_outline && (kind.key.ends_with(end) || kind.key.substr(0, kind.key.rfind('_')).ends_with(end)))
      return std::string(kind.key);
  return nearest(name, names_of(shorts, &ShortReading::name));
}

/// "measurements" from the sheet.
ordered_json measurements_of(const Sheet& sheet, const Test& test, Faults& faults) {
  auto out = ordered_json::object();
  const auto of_test = reading_kinds(test);
  for (const auto& [name, text] : sheet.readings) {
    const std::string_view key = key_of_reading(name);
    const auto kind = std::ranges::find(of_test, key, &ReadingKind::key);
    if (kind == of_test.end() || kind->key.empty() || kind->from_outline) {
      const auto near = meant_reading(name, of_test);
      faults.push_back({reading_fault_place(name), "is not a reading of a slump test",
                        near ? "did you mean " + *near + "?" : "e.g. slump=180 or spread=330"});
      continue;
    }
    if (out.contains(std::string(key))) {
      faults.push_back({reading_fault_place(name), "is given twice", "once, repeats as \"180, 175, 190\""});
      continue;
    }
    const auto values = value_or_append(values_of_reading(name, text, key, slump_of(test)), faults);
    if (!values) continue;
    const auto stated = deviation_in(sheet, key, faults);
    out[std::string(key)] = reading_json(*values, stated ? *stated : deviation_of(*kind, test, values->front()));
  }
  for (const auto& [name, text] : sheet.deviations)
    if (!out.contains(std::string(key_of_reading(name))))
      faults.push_back({"sd " + printable(name), "is of a reading that is not given", "give the reading, too"});
  return out;
}

/// Yield stresses of a rheometer from the sheet; may be empty.
std::vector<double> yield_stresses_in(const Sheet& sheet, Faults& faults) {
  if (sheet.yield_stress.empty()) return {};
  const auto read = value_or_append(written_readings("yield stress", sheet.yield_stress, "pa"), faults);
  if (!read) return {};
  if (std::ranges::all_of(*read, [](double pa) { return pa > 0; })) return *read;
  faults.push_back({"yield stress", "is not above 0", "in Pa, e.g. 520, or with its unit: \"0.52 kPa\""});
  return {};
}

/// Adds a yield stress, for comparison only, to "material"; the deviation of a single value is assumed.
void add_yield_stress(ordered_json& lab, const std::vector<double>& stresses_pa) {
  constexpr double share = 0.1;
  ordered_json& written = lab["material"]["yield_stress_pa"];
  if (stresses_pa.size() > 1) {
    written["repeats"] = stresses_pa;
    return;
  }
  written = {{"value", stresses_pa[0]}, {"standard_deviation", rounded(share * stresses_pa[0], 2)}};
  add_note(lab, "the standard deviation of the yield stress is assumed, a tenth");
}

/// "measurements" of a sheet with a yield stress only: the last predicted reading, whose formula is the most accurate.
/// Fault: there is none.
void predict_reading(ordered_json& lab, Test test, const std::vector<double>& stresses_pa, Faults& faults) {
  specimen_of(test).bulk_density_kg_m3 = lab["material"]["bulk_density_kg_m3"];
  const double yield_stress_pa =
      std::accumulate(stresses_pa.begin(), stresses_pa.end(), 0.0) / static_cast<double>(stresses_pa.size());
  const auto predicted = readings_of_fluid(test, yield_stress_pa);
  if (!predicted || predicted->empty()) {
    faults.push_back({"yield stress", "of " + shown(yield_stress_pa) + " Pa predicts no reading with this mould",
                      "a taller mould that is narrower at its top, or a reading, e.g. a slump"});
    return;
  }
  const PredictedReading& one = predicted->back();
  const std::string key(one.key);
  lab["measurements"][key] = {{"value", rounded(one.value, 3)},
                              {"standard_deviation", rounded(one.standard_deviation, 2)}};
  add_note(lab, key + " was not measured: it is what " + std::string(one.formula) +
                    " predicts of a fluid with a yield stress of " + shown(yield_stress_pa) +
                    " Pa, with the formula's own error");
}

Faults doubtful_numbers(const Sheet& sheet, const std::vector<double>& densities) {
  Faults faults;
  if (densities.size() > 1)
    faults.push_back({"density", "is given as " + std::to_string(densities.size()) + " numbers",
                      "one density of the fresh material, e.g. 2350"});
  const auto own = lengths_in(sheet.mould);
  const bool confirmed = std::ranges::count(sheet.confirmed, "mould") > 0;
  if (own && (*own)[1] > (*own)[0] && !confirmed)
    faults.push_back({"mould",
                      "is " + shown((*own)[0]) + " mm wide at its base and " + shown((*own)[1]) + " mm at its top",
                      "BASE/TOP/HEIGHT; if it stands upside down, say --confirm mould"});
  if (own && sheet.drops > 0)
    faults.push_back({"--drops", "is of a preset with a table that drops",
                      "describe the table in apparatus.drop_plate of the laboratory file"});
  return faults;
}

/// Adds a note on assumed apparatus values, which the file does not distinguish from measured ones.
void note_assumptions(ordered_json& lab, const Sheet& sheet) {
  if (lengths_in(sheet.mould)) {
    lab["assumed"] = {"apparatus.lift_velocity_mm_s"};
    add_note(lab, "the lift velocity is assumed: the mould is off in 3 s, at 50 mm/s or more");
  } else if (lab["apparatus"].contains("table_length_mm")) {
    add_note(lab, "the size of the table is assumed, because the heap is wider than the preset's");
  }
}

/// Strips the name of a file that does not exist yet from the places of the faults.
Faults of_no_file(Faults faults, const std::filesystem::path& file) {
  const std::string before = printable(file.string()) + ": ";
  for (Fault& fault : faults)
    if (fault.where.starts_with(before)) fault.where.erase(0, before.size());
  return faults;
}

std::string with_head(std::string_view head, const ordered_json& document) {
  return std::string(head) + "\n" + document.dump(2) + "\n";
}

}  // namespace

std::span<const ShortReading> short_readings() {
  return shorts;
}

Result<Test> apparatus_of(const std::string& mould, const std::filesystem::path& folder) {
  Faults faults;
  Test test = SlumpTest{};
  const json document{{"apparatus", apparatus_json(mould, folder)}};
  {
    ObjectReader reader(document, "", faults);
    read_apparatus(reader, test, folder);
  }
  const bool digit = mould.find_first_of("0123456789") == mould.find_first_not_of(' ');
  const bool no_preset = faults.size() == 1 && faults[0].where == "apparatus.preset";
  if (no_preset && digit)
    return Fault{"mould",
                 "is " + in_quotes(mould) + ": no preset, and no three lengths in one unit or with a unit each",
                 "BASE/TOP/HEIGHT in mm, \"200/100/300\", or \"8/4/12 in\", \"8 in/100 mm/300 mm\""};
  if (!faults.empty()) return faults;
  return test;
}

Result<StartingFiles> starting_files(const Sheet& sheet, const std::filesystem::path& folder) {
  Faults faults;
  const auto laws = laws_for(sheet.target, sheet.law);
  if (!laws) faults.push_back(no_such_laws(sheet.target, sheet.law));
  const auto density = value_or_append(written_readings("density", sheet.density, "kg_m3"), faults);
  const auto test = value_or_append(apparatus_of(sheet.mould, folder), faults);
  ordered_json measurements;
  if (test) measurements = measurements_of(sheet, *test, faults);
  const std::vector<double> stresses_pa = yield_stresses_in(sheet, faults);
  if (density) append(faults, doubtful_numbers(sheet, *density));
  ordered_json grains;
  if (test) grains = grains_json(sheet, *test, faults);
  if (test && sheet.readings.empty() && sheet.yield_stress.empty())
    faults.push_back({"readings", "there is none", "give at least one, e.g. a slump or a spread"});
  if (!faults.empty()) return faults;

  ordered_json lab{
      {"format", "pastefit-lab-1"},
      {"title", one_line(sheet.title)},
      {"provenance", {{"source", sheet.source.empty() ? std::string(kSourceToFillIn) : one_line(sheet.source)}}},
      {"apparatus", apparatus_json(sheet, folder, slump_of(*test), measurements)},
      {"material", {{"bulk_density_kg_m3", density->front()}}},
      {"grains", grains},
      {"measurements", measurements}};
  for (const auto& [name, value] : sheet.mix) lab["mix"][name] = value;
  for (const std::string& place : sheet.confirmed) lab["confirmed"].push_back(one_line(place));
  note_assumptions(lab, sheet);
  if (!stresses_pa.empty()) add_yield_stress(lab, stresses_pa);
  if (sheet.readings.empty()) predict_reading(lab, *test, stresses_pa, faults);
  if (!faults.empty()) return faults;
  const auto read = lab_from_json(json::parse(lab.dump()), folder);
  if (!read.ok()) return read.faults();
  constexpr double most_grains = 1e6;
  if (const double count = grains_needed(read.value().test); count > most_grains)
    return Fault{"grains", "would be " + shown(rounded(count, 2)) + " in the mould",
                 "larger grains: at most a million"};
  const StartingStudy study = starting_study(sheet, *laws, slump_of(*test), lab, read.value().measurements, faults);
  if (!faults.empty()) return faults;
  json whole = json::parse(study.document.dump());
  whole["lab"] = json::parse(lab.dump());
  const auto made = study_from_json(std::move(whole), folder / "study.json");
  if (!made.ok()) return of_no_file(made.faults(), folder / "study.json");
  return StartingFiles{
      with_head("// What the laboratory measured. Grains and deviations follow from the mould.", lab),
      with_head("// What is fitted to it: the laws are those of " + std::string(laws->target) + ". " + study.why + ".",
                study.document)};
}

}  // namespace pastefit
