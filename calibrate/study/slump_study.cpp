#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/base/units.h"
#include "calibrate/laboratory/slump.h"
#include "calibrate/study/slump_sheet.h"

namespace pastefit {

using nlohmann::ordered_json;

namespace {

/// Angles of repose are only measured on dry materials.
bool is_dry(const ordered_json& measurements) {
  return measurements.contains("step1.angle_of_repose_deg");
}

/// Laws of non-adhesive grains, with the rolling model of the target.
ordered_json dry_contact(const TargetLaws& laws) {
  return {{"normal", "hertz"},
          {"attraction", "none"},
          {"rolling_model", laws.rolling_model},
          {"friction_basis", "elastic"}};
}

/// Laws, and the reason given in the study.
struct ChosenLaws {
  TargetLaws laws;
  std::string why;
};

bool is_pat(std::span<const Measurement> measured) {
  return find_measurement(measured, "tilt.slide_angle_deg") != nullptr;
}

/// Width of the heap relative to the cone of the same volume and height; none if height or spread is missing, or the
/// heap is a pat.
std::optional<double> share_of_cone(const SlumpTest& test, std::span<const Measurement> measured) {
  const auto* height = find_measurement(measured, "step1.height_mm");
  const auto* spread = find_measurement(measured, "step1.spread_mm");
  if (!height || !spread || is_pat(measured)) return std::nullopt;
  return spread->value / cone_width_mm(test, height->value);
}

/// Ordinary heaps have 0.7 to 0.95 of a cone's width, or are low.
enum class HeapWidth { ordinary, narrow, wide };
constexpr double kWide = 0.95;

/// Narrow heaps are narrower than any heap that slides on its table: with 0.43 to 0.5 of the Abrams cone's height and
/// 0.67 of a cone's width, only grains that adhere to the table reproduce them, not friction alone. High friction
/// between the grains reproduces wide ones (tests/results/concretes.md). The pat of an inclined plate keeps its shape.
HeapWidth width_of(const SlumpTest& test, std::span<const Measurement> measured) {
  constexpr double narrow = 0.7, low = 0.25;
  const std::optional<double> share = share_of_cone(test, measured);
  if (!share || find_measurement(measured, "step1.height_mm")->value < 1e3 * low * test.mould.height_m)
    return HeapWidth::ordinary;
  return *share < narrow ? HeapWidth::narrow : *share > kWide ? HeapWidth::wide : HeapWidth::ordinary;
}

/// Laws named in the sheet, otherwise those of the target that suit the readings. Heaps that keep more than half of
/// their height get elasto-plastic adhesion where the target has it, because heaps of its other laws shear off or keep
/// the mould's shape. So do heights with spreads, except of wide heaps, for LIGGGHTS, whose SJKR reproduces fewer of
/// them; EDEM's elasto-plastic adhesion gives other heaps than the card (tests/results/laws.md). Others get the
/// target's first law: the strength of a bridge does not depend on the size of the mould. So do timed flows, because
/// only a bridge has a viscosity, and sheets with a yield stress only.
ChosenLaws laws_of(const Sheet& sheet, const TargetLaws& named, const SlumpTest& test,
                   std::span<const Measurement> measured) {
  constexpr double stands = 0.5;
  ChosenLaws first{named, std::string(named.why)};
  const auto epa = laws_for(sheet.target, "epa");
  if (!sheet.law.empty() || !epa) return first;
  if (named.law == "bridge") {
    if (find_measurement(measured, "step1.t500_s") || find_measurement(measured, "step1.flow_time_s"))
      return {named, "The flow is timed, and of the laws only a bridge has a viscosity"};
    if (sheet.readings.empty())
      return {named, "A yield stress is known, and of the laws a bridge has a strength in Pa"};
  }
  const auto* height = find_measurement(measured, "step1.height_mm");
  if (height && height->value > 1e3 * stands * test.mould.height_m && !is_pat(measured))
    return {*epa, "More than half of the height is left: heaps of " + std::string(named.law) +
                      " shear off there, heaps of elasto-plastic adhesion stand"};
  if (width_of(test, measured) == HeapWidth::narrow)
    return {*epa, "The heap is narrow: heaps of elasto-plastic adhesion that stick to the table are"};
  const std::optional<double> share = share_of_cone(test, measured);
  if (named.law == "sjkr" && share && *share <= kWide)
    return {*epa, "Heaps of elasto-plastic adhesion reproduce more heights and spreads than heaps of " +
                      std::string(named.law)};
  return first;
}

/// Height and spread, or the spreads before and after the drops of a table, identify strength and friction; one of them
/// only the strength. A flow time identifies the viscosity of laws that have one.
ordered_json parameters_for(const TargetLaws& laws, const ordered_json& measurements, double radius_mm,
                            HeapWidth width) {
  if (is_dry(measurements))
    return ordered_json::parse(*template_text("study-lifted-cylinder"), nullptr, true, true)["parameters"];
  const auto is_there = [&](std::string_view part) {
    for (const auto& [key, reading] : measurements.items())
      if (key.find(part) != std::string::npos) return true;
    return false;
  };
  const bool both = is_there("spread") && (is_there("slump") || is_there("height") ||
                                           (is_there("step1.spread") && is_there("after_drops.spread")));
  ordered_json out = starting_parameters(laws.laws(), both);
  if (width == HeapWidth::narrow && laws.law == "epa") {
    out["table_cohesion_factor"] = {{"value", 1}};
    out["table_friction"].erase("prior");  // it is of heaps that slide
  }
  if (width == HeapWidth::wide && laws.law == "bridge" && both)
    out["friction"] = {{"free", {0.05, 0.8}}, {"scale", "log"}};
  if (is_there("step2.") && laws.law == "epa") {  // five readings determine three parameters
    out["friction"] = {{"free", {0.05, 0.3}}, {"scale", "log"}};
    out["table_friction"].erase("prior");
  }
  if (is_there("slide_angle")) {
    out["table_friction"] = {{"free", {0.05, 1.2}}, {"scale", "log"}};
    out["table_rolling_friction"] = {{"value", 0.5}};  // a base that slides, instead of rolling before
  }
  bool timed = false;
  for (const auto& [key, reading] : measurements.items()) timed = timed || key.ends_with("_s");
  if (timed && laws.law == "bridge" && laws.target == "lammps") {
    const double most_pa_s = rounded(0.4 * radius_mm, 2);  // larger ones need shorter steps, by the radius
    out["viscosity_pa_s"] = {{"free", {rounded(most_pa_s / 100, 2), most_pa_s}}, {"scale", "log"}};
  }
  return out;
}

/// Adds fixed values and priors of parameters from the sheet.
void add_knowledge(ordered_json& study, const Sheet& sheet, Faults& faults) {
  ordered_json& parameters = study["parameters"];
  for (const auto& [name, text] : sheet.fixed) {
    if (const auto value = written_number(text); value && !value->unit && !value->comma)
      parameters[name] = {{"value", value->value}};
    else
      faults.push_back({"fix " + printable(name), "is " + in_quotes(text), "a number, e.g. friction=0.2"});
  }
  for (const auto& [name, text] : sheet.priors) {
    const std::size_t sign = text.find("+-");
    const auto value = written_number(text.substr(0, sign));
    const auto deviation = sign == std::string::npos ? std::nullopt : written_number(text.substr(sign + 2));
    const bool free = parameters.contains(name) && parameters[name].contains("free");
    if (!value || !deviation || value->unit || deviation->unit || value->comma || deviation->comma)
      faults.push_back({"prior " + printable(name), "is " + in_quotes(text), "e.g. friction=0.2+-0.05"});
    else if (!free)
      faults.push_back(
          {"prior " + printable(name), "is of a parameter that is not searched", "fix it, or leave it out"});
    else
      parameters[name]["prior"] = {{"value", value->value}, {"standard_deviation", deviation->value}};
  }
}

}  // namespace

StartingStudy starting_study(const Sheet& sheet, const TargetLaws& named, const SlumpTest& test,
                             const ordered_json& lab, std::span<const Measurement> measured, Faults& faults) {
  const ordered_json &measurements = lab.at("measurements"), &grains = lab.at("grains");
  const ChosenLaws chosen = laws_of(sheet, named, test, measured);
  StartingStudy study{{{"format", "pastefit-study-1"},
                       {"title", one_line(sheet.title)},
                       {"lab", "lab.json"},
                       {"contact", is_dry(measurements) ? dry_contact(named) : contact_of(chosen.laws)},
                       {"parameters", parameters_for(chosen.laws, measurements,
                                                     grains.value("largest_mm", grains.value("radius_mm", 0.0)),
                                                     width_of(test, measured))},
                       {"search",
                        {{"screening", 8},
                         {"budget_simulations", 150},
                         {"packings", 2},
                         {"confirmation_packings", 8},
                         {"examination_simulations", 12},
                         {"seed", 1}}}},
                      chosen.why};
  add_knowledge(study.document, sheet, faults);
  return study;
}

}  // namespace pastefit
