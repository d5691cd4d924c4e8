#include "calibrate/study/target_laws.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "calibrate/base/embedded_text.h"
#include "calibrate/base/text.h"

namespace pastefit {
namespace {

// Bounds of the adhesion range from collapsing heaps to heaps that keep their shape. Bridge: pull-offs of about 10 to
// 40,000 R^2 Pa; other laws: what the softest admissible grains support (JKR: 4.7 R^2 times surface energy over R;
// SJKR: the cube of the energy density).
// Priors: height and spread do not determine a friction, a rolling friction and the range of a bridge besides its
// strength, nor the friction of the table beside an adhesion ratio. They are the middle and a third of the range in
// which concretes are reproduced (tests/results/laws.md).
constexpr std::string_view
    slippery = R"({"free": [0.05, 0.3], "scale": "log", "prior": {"value": 0.15, "standard_deviation": 0.06}})",
    slips = R"({"value": 0.15})", rolls = R"({"free": [0, 0.5], "prior": {"value": 0.25, "standard_deviation": 0.1}})",
    rolls_well = R"({"value": 0.02})",
    reaches = R"({"free": [0.4, 1], "scale": "log", "prior": {"value": 0.6, "standard_deviation": 0.12}})";
constexpr StartingParameter sliding{"friction", slippery, slips, "between grains; heaps with more shear off"};
constexpr StartingParameter rolling{"rolling_friction", rolls, rolls_well, "between grains"};

constexpr std::array<StartingParameter, 5> of_epa{{
    {"adhesion_ratio", R"({"free": [0.05, 4], "scale": "log"})", R"({"free": [0.05, 4], "scale": "log"})",
     "stiffness of the adhesion branch over that of loading"},
    {"plasticity_ratio", R"({"value": 0.85})", R"({"value": 0.85})", "share of the deepest overlap that stays"},
    {"friction", R"({"value": 0.05})", R"({"value": 0.05})", "between grains; heaps with more shear off"},
    {"rolling_friction", R"({"value": 0.01})", R"({"value": 0.01})", "between grains"},
    {"table_friction", R"({"free": [0.02, 0.6], "scale": "log", "prior": {"value": 0.1, "standard_deviation": 0.08}})",
     R"({"value": 0.15})", "between grains and table: the less, the wider a heap of its height"},
}};

constexpr std::array<StartingParameter, 7> of_bridge{{
    {"strength_pa", R"({"free": [10, 40000], "scale": "log"})", R"({"free": [10, 40000], "scale": "log"})",
     "attraction at touch over R^2"},
    // A tough bridge, with which heaps keep their shape (tests/results/standing_heaps.md).
    {"rupture_force_ratio", R"({"value": 0.5})", "", "share of it left when the bridge ruptures"},
    {"curvature", R"({"value": -0.5})", "", "decay: -1 flat at touch, 0 straight, 1 flat at rupture"},
    {"rupture_gap_ratio", reaches, R"({"free": [0.15, 1], "scale": "log"})", "gap at rupture over R"},
    {"formation_ratio", R"({"value": 0.3})", R"({"value": 1})",
     "gap at which a bridge forms over the one at which it ruptures"},
    sliding,
    rolling,
}};

constexpr std::array<StartingParameter, 3> of_jkr{{
    {"adhesion_pa", R"({"free": [10, 5000], "scale": "log"})", R"({"free": [10, 5000], "scale": "log"})",
     "surface energy over R"},
    sliding,
    rolling,
}};

constexpr std::array<StartingParameter, 3> of_sjkr{{
    {"cohesion_energy_density_pa", R"({"free": [15000, 120000], "scale": "log"})",
     R"({"free": [15000, 120000], "scale": "log"})", "attraction over the area in which grains meet"},
    sliding,
    rolling,
}};

constexpr std::array<StartingLaws, 4> known_laws{{
    {"bridge", "hertz", "polynomial", of_bridge},
    {"epa", "epa", "none", of_epa},
    {"jkr", "jkr", "none", of_jkr},
    {"sjkr", "sjkr", "none", of_sjkr},
}};

constexpr std::array<TargetLaws, 9> known_targets{{
    {"lammps", "lammps", "bridge", "spring_dashpot", "total",
     "LAMMPS runs these laws, as every law here, with the style that the export brings"},
    {"lammps", "lammps", "epa", "spring_dashpot", "elastic",
     "LAMMPS runs elasto-plastic adhesion with the style that the export brings"},
    {"lammps", "lammps", "jkr", "spring_dashpot", "total", "LAMMPS runs JKR with the style that the export brings"},
    {"lammps", "lammps", "sjkr", "spring_dashpot", "elastic",
     "LAMMPS runs simplified JKR with the style that the export brings"},
    {"liggghts", "liggghts", "sjkr", "spring_dashpot", "elastic", "LIGGGHTS has SJKR, and no polynomial bridge"},
    {"liggghts", "liggghts", "epa", "spring_dashpot", "elastic",
     "LIGGGHTS has elasto-plastic adhesion with linear springs, which match the card's at one overlap"},
    {"yade", "yade", "bridge", "spring_dashpot", "elastic",
     "Yade runs the bridge in Python, with friction of the elastic force"},
    {"edem", "edem-notes", "jkr", "constant_torque", "elastic", "EDEM has JKR, and no liquid bridge of this kind"},
    {"edem", "edem-notes", "epa", "constant_torque", "elastic",
     "EDEM has elasto-plastic adhesion as EEPA, whose pull-off matches the card's at one depth of contact"},
}};

template <class List>
std::string listed_once(const List& list, std::string_view List::value_type::*name) {
  std::vector<std::string_view> words;
  for (const auto& one : list)
    if (std::ranges::count(words, one.*name) == 0) words.push_back(one.*name);
  return listed(words);
}

/// Lines of "parameters" in a study, each with its meaning.
std::vector<std::string> parameter_lines(const StartingLaws& laws) {
  std::vector<std::string> out;
  for (const StartingParameter& one : laws.parameters)
    out.push_back("\"" + std::string(one.name) + "\": " + std::string(one.of_two) +
                  (&one == &laws.parameters.back() ? "" : ",") + "  // " + std::string(one.meaning));
  return out;
}

}  // namespace

const StartingLaws& TargetLaws::laws() const {
  return *std::ranges::find(known_laws, law, &StartingLaws::word);
}

std::span<const TargetLaws> target_laws() {
  return known_targets;
}

std::optional<TargetLaws> laws_for(std::string_view given, std::string_view law) {
  const std::string target = small_letters(given);  // programs also write their names in capitals
  const auto found = std::ranges::find_if(known_targets, [&](const TargetLaws& laws) {
    return (laws.target == target || laws.export_target == target) && (law.empty() || laws.law == law);
  });
  return found == known_targets.end() ? std::nullopt : std::optional(*found);
}

Fault no_such_laws(std::string_view target, std::string_view law) {
  if (!laws_for(target))
    return {"--for " + printable(target), "is not a program that pastefit knows the laws of",
            "one of " + names_of_targets()};
  if (std::ranges::count(known_laws, law, &StartingLaws::word) == 0)
    return {"--law " + printable(law), "is not a law that a study can start from", "one of " + names_of_laws()};
  std::vector<std::string_view> others;
  for (const TargetLaws& laws : known_targets)
    if (laws.target == target) others.push_back(laws.law);
  return {"--law " + printable(law), "is a law that " + std::string(target) + " does not run",
          "one of " + listed(others)};
}

std::string names_of_targets() {
  return listed_once(known_targets, &TargetLaws::target);
}

std::string names_of_laws() {
  return listed_once(known_laws, &StartingLaws::word);
}

std::string with_laws(std::string study, const TargetLaws& laws) {
  replace_lines(study,
                "\"contact\":", {"// " + std::string(laws.why) + ".", "\"contact\": " + contact_of(laws).dump() + ","});
  replace_inside(study, "\"parameters\":", parameter_lines(laws.laws()));
  return study;
}

nlohmann::ordered_json contact_of(const TargetLaws& laws) {
  nlohmann::ordered_json out{{"normal", laws.laws().normal}, {"attraction", laws.laws().attraction}};
  if (laws.laws().attraction != "none") out["formation"] = "film";
  out["rolling_model"] = laws.rolling_model;
  out["friction_basis"] = laws.friction_basis;
  return out;
}

nlohmann::ordered_json starting_parameters(const StartingLaws& laws, bool both) {
  nlohmann::ordered_json out;
  for (const StartingParameter& one : laws.parameters)
    if (const std::string_view text = both ? one.of_two : one.of_one; !text.empty())
      out[std::string(one.name)] = nlohmann::ordered_json::parse(text);
  return out;
}

}  // namespace pastefit
