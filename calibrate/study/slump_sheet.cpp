#include "calibrate/study/slump_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "calibrate/base/fault_text.h"
#include "calibrate/base/json_reader.h"
#include "calibrate/base/rounded.h"
#include "calibrate/base/units.h"
#include "calibrate/study/apparatus.h"
#include "calibrate/study/lab.h"
#include "core/apparatus/reading_kind.h"

namespace pastefit {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::array<ShortReading, 12> shorts{{
    {"slump", "step1.slump_mm", "what is missing to the mould's height"},
    {"height", "step1.height_mm", "the height that is left"},
    {"spread", "step1.spread_mm", "width of the heap"},
    {"shift", "step1.lateral_shift_mm", "of the middle of the top"},
    {"angle", "step1.angle_of_repose_deg", "of repose, of a dry material"},
    {"height2", "step2.height_mm", "after the plate's drop"},
    {"slump2", "step2.slump_mm", "after the plate's drop"},
    {"spread2", "step2.spread_mm", "after the plate's drop"},
    {"sag", "step2.plateau_sag_mm", "how much lower the top lies on the free side"},
    {"flow", "after_drops.spread_mm", "width after all drops of the table"},
    {"height-after", "after_drops.height_mm", "after all drops of the table"},
    {"mass", "fill.mass_kg", "of the full mould's content"},
}};

std::string_view key_of_reading(std::string_view name) {
  const auto found = std::ranges::find(shorts, name, &ShortReading::name);
  return found == shorts.end() ? name : found->key;
}

std::string reading_fault_place(std::string_view name) {
  return "reading " + printable(name);
}

/// Three lengths in mm from "200/100/300" or "8/4/12 in". Nothing if it is none.
std::optional<std::array<double, 3>> lengths_in(const std::string& text) {
  std::array<double, 3> out{};
  std::optional<Unit> unit;
  std::size_t start = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t end = i + 1 < out.size() ? text.find('/', start) : text.size();
    if (end == std::string::npos) return std::nullopt;
    const auto number = written_number(std::string_view(text).substr(start, end - start));
    if (!number) return std::nullopt;
    out[i] = number->value;
    if (number->unit) unit = number->unit;
    start = end + 1;
  }
  if (unit && unit->key != "mm") return std::nullopt;
  for (double& length : out) length = rounded(length * (unit ? unit->factor : 1), 6);
  return out;
}

/// A mould of one's own on a table that its heap does not leave, lifted in 3 s but no slower than 50 mm/s.
ordered_json own_apparatus(const std::array<double, 3>& mould) {
  const auto [base, top, height] = mould;
  const double wider = std::max(base, top);
  return {{"mould", {{"base_diameter_mm", base}, {"top_diameter_mm", top}, {"height_mm", height}}},
          {"table_length_mm", rounded(std::max(4.5 * wider, 3 * height), 3)},
          {"lift_velocity_mm_s", rounded(std::max(height / 3, 50.0), 3)},
          {"drop_plate", nullptr},
          {"reading", {{"height", "axis"}, {"probe_diameter_mm", rounded(wider / 5, 3)}}}};
}

/// "apparatus" of a laboratory file.
ordered_json apparatus_json(const std::string& mould) {
  if (const auto own = lengths_in(mould)) return own_apparatus(*own);
  return {{"preset", mould}};
}

const SlumpTest& slump_of(const Test& test) {
  return std::get<SlumpTest>(test);
}

/// Radii about that of the preset, a quarter of it to either side: equal spheres lie in layers and shear off along
/// them. Of another mould, as many grains as an Abrams cone has with 8 mm.
ordered_json grains_json(const Test& test, bool preset) {
  constexpr double of_opening = 0.08;
  const Mould& mould = slump_of(test).mould;
  const double opening_mm = 1e3 * std::min(2 * narrower_radius_m(mould), mould.height_m);
  const double radius_mm = preset ? 1e3 * specimen_of(test).grains.radius_m : of_opening * opening_mm;
  return {{"distribution", "uniform"},
          {"smallest_mm", rounded(0.75 * radius_mm, 3)},
          {"largest_mm", rounded(1.25 * radius_mm, 3)}};
}

/// The deviation of one reading: as published for this mould, else the share that is published for a height. Of an
/// angle of repose nothing is published; 1.5 degrees is what calibrations of wheat assume (data/lab/wheat-repose.json).
double deviation_of(const ReadingKind& kind, const Test& test, double value) {
  constexpr double share_of_mass = 0.01, share_of_height = 0.025, of_angle_deg = 1.5;
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

/// Adds a sentence to what the file says of its numbers.
void add_note(ordered_json& lab, const std::string& note) {
  std::string notes = lab["provenance"].value("notes", "");
  lab["provenance"]["notes"] = notes + (notes.empty() ? "" : "; ") + note;
}

/// "measurements": what the sheet says.
ordered_json measurements_of(const Sheet& sheet, const Test& test, Faults& faults) {
  auto out = ordered_json::object();
  const auto of_test = reading_kinds(test);
  std::set<std::string, std::less<>> names;
  for (const ShortReading& one : shorts) names.emplace(one.name);
  for (const auto& [name, text] : sheet.readings) {
    const std::string_view key = key_of_reading(name);
    const auto kind = std::ranges::find(of_test, key, &ReadingKind::key);
    if (kind == of_test.end() || kind->key.empty() || kind->from_outline) {
      const auto near = nearest(name, names);
      faults.push_back({reading_fault_place(name), "is no reading of a slump test",
                        near ? "did you mean " + *near + "?" : "e.g. slump=180 or spread=330"});
      continue;
    }
    const auto unit = unit_of_key(key);
    const auto values = written_readings(reading_fault_place(name), text, unit ? unit->key : "");
    if (!values.ok()) {
      faults.insert(faults.end(), values.faults().begin(), values.faults().end());
      continue;
    }
    out[std::string(key)] = reading_json(values.value(), deviation_of(*kind, test, values.value()[0]));
  }
  return out;
}

/// What a vane read, as the sheet says; nothing if it does not.
std::vector<double> yield_stresses_in(const Sheet& sheet, Faults& faults) {
  if (sheet.yield_stress.empty()) return {};
  const auto read = written_readings("yield stress", sheet.yield_stress, "pa");
  if (!read.ok()) {
    faults.insert(faults.end(), read.faults().begin(), read.faults().end());
    return {};
  }
  if (std::ranges::all_of(read.value(), [](double pa) { return pa > 0; })) return read.value();
  faults.push_back({"yield stress", "is not above 0", "in Pa, e.g. 520, or with its unit: \"0.52 kPa\""});
  return {};
}

/// "material" with a yield stress to be compared; the deviation of a single one is assumed.
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

/// "measurements" of a sheet that has a yield stress only: the last reading that it predicts, whose formula holds best.
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

/// An angle of repose is measured of dry materials.
bool is_dry(const ordered_json& measurements) {
  return measurements.contains("step1.angle_of_repose_deg");
}

/// As in the template of the lifted cylinder.
ordered_json dry_parameters() {
  return {{"friction", {{"free", {0.2, 0.8}}}},
          {"rolling_friction", {{"free", {0.02, 0.5}}}},
          {"table_friction", {{"value", 0.5}}},
          {"table_rolling_friction", {{"value", 0.1}}},
          {"mould_friction", {{"value", 0.4}}}};
}

/// Laws of grains that nothing attracts, with the rolling model of the target.
ordered_json dry_contact(const TargetLaws& laws) {
  return {{"normal", "hertz"},
          {"attraction", "none"},
          {"rolling_model", laws.rolling_model},
          {"friction_basis", "elastic"}};
}

/// A law, and the reason for it that the study gives.
struct ChosenLaws {
  TargetLaws laws;
  std::string why;
};

/// The laws that the sheet names, or those that its target starts from. Where the sheet names none and the target runs
/// both, heaps that keep more than half of their height get elasto-plastic adhesion: those of a bridge shear off.
/// Others get the bridge, whose strength does not depend on the size of the mould (tests/results/laws.md); so do timed
/// flows, because only a bridge has a viscosity.
ChosenLaws laws_of(const Sheet& sheet, const TargetLaws& named, const SlumpTest& test,
                   std::span<const Measurement> measured) {
  constexpr double stands = 0.5;
  const auto bridge = laws_for(sheet.target, "bridge"), epa = laws_for(sheet.target, "epa");
  if (!sheet.law.empty() || !bridge || !epa) return {named, std::string(named.why)};
  if (find_measurement(measured, "step1.t500_s") || find_measurement(measured, "step1.flow_time_s"))
    return {*bridge, "The flow is timed, and of the laws only a bridge has a viscosity"};
  const auto* height = find_measurement(measured, "step1.height_mm");
  if (height && height->value > 1e3 * stands * test.mould.height_m)
    return {*epa,
            "More than half of the height is left: heaps of a bridge shear off there, heaps of elasto-plastic "
            "adhesion stand"};
  return {*bridge, std::string(bridge->why)};
}

/// A height and a spread, or the spreads before and after the drops of a table, tell strength and friction apart; one
/// of them alone tells the strength.
ordered_json parameters_for(const TargetLaws& laws, const ordered_json& measurements) {
  if (is_dry(measurements)) return dry_parameters();
  const auto is_there = [&](std::string_view part) {
    for (const auto& [key, reading] : measurements.items())
      if (key.find(part) != std::string::npos) return true;
    return false;
  };
  const bool both = is_there("spread") && (is_there("slump") || is_there("height") ||
                                           (is_there("step1.spread") && is_there("after_drops.spread")));
  return parameters_of(laws.laws(), both);
}

std::string with_head(std::string_view head, const ordered_json& document) {
  return std::string(head) + "\n" + document.dump(2) + "\n";
}

}  // namespace

std::span<const ShortReading> short_readings() {
  return shorts;
}

Result<std::vector<double>> written_readings(const std::string& where, const std::string& text,
                                             std::string_view unit_key) {
  const auto unit_now = unit_of_word(unit_key);
  const std::string own = unit_now ? " in " + std::string(unit_now->name) : "";
  const auto wrong = [&](std::string what) {
    return Fault{where, std::move(what), "numbers" + own + " or with their unit, e.g. \"180, 175, 190\""};
  };
  std::vector<WrittenNumber> numbers;
  std::size_t start = 0;
  while (start < text.size()) {
    // A number ends at a semicolon, at a comma before a space, or at a space before a digit.
    std::size_t end = start;
    for (; end < text.size(); ++end) {
      const char next = end + 1 < text.size() ? text[end + 1] : ' ';
      const bool digit = (next >= '0' && next <= '9') || next == '-' || next == '.';
      if (text[end] == ';' || (text[end] == ',' && next == ' ') || (text[end] == ' ' && digit && end > start)) break;
    }
    const std::string_view part = std::string_view(text).substr(start, end - start);
    start = end + 1;
    if (part.find_first_not_of(' ') == std::string_view::npos) continue;
    const auto number = written_number(part);
    if (!number) return wrong("holds " + in_quotes(part) + ", which is no number");
    if (number->comma)
      return Fault{where, "holds " + in_quotes(part),
                   "a decimal point, or a space after the comma between two numbers"};
    numbers.push_back(*number);
  }
  if (numbers.empty()) return wrong("is empty");
  const std::optional<Unit> last = numbers.back().unit;
  std::vector<double> out;
  for (const WrittenNumber& number : numbers) {
    const std::optional<Unit> unit = number.unit ? number.unit : last;
    if (unit && unit->key != unit_key) return wrong("is in " + std::string(unit->name));
    out.push_back(rounded(number.value * (unit ? unit->factor : 1), 6));
  }
  return out;
}

Result<Test> apparatus_of(const std::string& mould, const std::filesystem::path& folder) {
  Faults faults;
  Test test = SlumpTest{};
  const json document{{"apparatus", apparatus_json(mould)}};
  {
    ObjectReader reader(document, "", faults);
    read_apparatus(reader, test, folder);
  }
  if (!faults.empty()) return faults;
  return test;
}

Result<StartingFiles> starting_files(const Sheet& sheet, const std::filesystem::path& folder) {
  Faults faults;
  const auto laws = laws_for(sheet.target, sheet.law);
  if (!laws) faults.push_back(no_such_laws(sheet.target, sheet.law));
  const auto density = written_readings("density", sheet.density, "kg_m3");
  if (!density.ok()) faults.insert(faults.end(), density.faults().begin(), density.faults().end());
  const auto test = apparatus_of(sheet.mould, folder);
  if (!test.ok()) faults.insert(faults.end(), test.faults().begin(), test.faults().end());
  ordered_json measurements;
  if (test.ok()) measurements = measurements_of(sheet, test.value(), faults);
  const std::vector<double> stresses_pa = yield_stresses_in(sheet, faults);
  if (test.ok() && sheet.readings.empty() && sheet.yield_stress.empty())
    faults.push_back({"readings", "there is none", "give at least one, e.g. a slump or a spread"});
  if (!faults.empty()) return faults;

  ordered_json lab{{"format", "pastefit-lab-1"},
                   {"title", sheet.title},
                   {"provenance", {{"source", "laboratory, person, date"}}},
                   {"apparatus", apparatus_json(sheet.mould)},
                   {"material", {{"bulk_density_kg_m3", density.value()[0]}}},
                   {"grains", grains_json(test.value(), !lengths_in(sheet.mould))},
                   {"measurements", measurements}};
  if (!sheet.confirmed.empty()) lab["confirmed"] = sheet.confirmed;
  if (!stresses_pa.empty()) add_yield_stress(lab, stresses_pa);
  if (sheet.readings.empty()) predict_reading(lab, test.value(), stresses_pa, faults);
  if (!faults.empty()) return faults;
  measurements = lab["measurements"];
  const auto read = lab_from_json(json::parse(lab.dump()), folder);
  if (!read.ok()) return read.faults();
  const auto chosen = laws_of(sheet, *laws, slump_of(test.value()), read.value().measurements);
  const ordered_json study{{"format", "pastefit-study-1"},
                           {"title", sheet.title},
                           {"lab", "lab.json"},
                           {"contact", is_dry(measurements) ? dry_contact(*laws) : contact_of(chosen.laws)},
                           {"parameters", parameters_for(chosen.laws, measurements)},
                           {"search",
                            {{"screening", 8},
                             {"budget_simulations", 150},
                             {"packings", 2},
                             {"confirmation_packings", 8},
                             {"examination_simulations", 12},
                             {"seed", 1}}}};
  return StartingFiles{
      with_head("// What the laboratory measured. Grains and deviations follow from the mould.", lab),
      with_head("// What is fitted to it: the laws are those of " + std::string(laws->target) + ". " + chosen.why + ".",
                study)};
}

}  // namespace pastefit
