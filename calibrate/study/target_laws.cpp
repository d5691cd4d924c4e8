#include "calibrate/study/target_laws.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace pastefit {
namespace {

// The bounds of a strength reach from heaps that flow away to heaps that stand: pull-offs of about 10 to 40,000 R^2 Pa
// of a bridge, and of the other laws what their softest grains bear (4.7 R^2 of JKR's surface energy over R; of SJKR
// the cube of its energy density).
constexpr std::array<TargetLaws, 4> known_targets{{
    {"lammps", "lammps", "hertz", "polynomial", "spring_dashpot", "total", "strength_pa", 10, 40000,
     "LAMMPS runs every law of pastefit with the style that the export brings"},
    {"liggghts", "liggghts", "sjkr", "none", "spring_dashpot", "elastic", "cohesion_energy_density_pa", 15000, 120000,
     "LIGGGHTS has SJKR, and no polynomial bridge"},
    {"yade", "yade", "hertz", "polynomial", "spring_dashpot", "elastic", "strength_pa", 10, 40000,
     "Yade runs the bridge in Python, with friction of the elastic force"},
    {"edem", "edem-notes", "jkr", "none", "constant_torque", "elastic", "adhesion_pa", 10, 5000,
     "EDEM has JKR, and no liquid bridge of this kind"},
}};

}  // namespace

std::span<const TargetLaws> target_laws() {
  return known_targets;
}

std::optional<TargetLaws> laws_for(std::string_view target) {
  const auto found = std::ranges::find_if(
      known_targets, [&](const TargetLaws& laws) { return laws.target == target || laws.export_target == target; });
  return found == known_targets.end() ? std::nullopt : std::optional(*found);
}

std::string names_of_targets() {
  std::string out;
  for (const TargetLaws& laws : known_targets) out += (out.empty() ? "" : ", ") + std::string(laws.target);
  return out;
}

std::string with_laws(const std::string& study, const TargetLaws& laws) {
  constexpr std::array<std::string_view, 4> of_bridge{"rupture_force_ratio", "curvature", "rupture_gap_ratio",
                                                      "formation_ratio"};
  std::string out;
  for (std::size_t start = 0; start < study.size();) {
    const std::size_t end = std::min(study.find('\n', start), study.size() - 1) + 1;
    std::string line = study.substr(start, end - start);
    start = end;
    const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
    const auto is_key = [&](std::string_view key) {
      return std::string_view(line).substr(first).starts_with("\"" + std::string(key) + "\"");
    };
    const auto number = [](double value) { return nlohmann::json(value).dump(); };
    if (is_key("contact"))
      line = "  // " + std::string(laws.why) + ".\n  \"contact\": " + contact_of(laws).dump() + ",\n";
    else if (is_key("strength_pa") && laws.strength != "strength_pa")
      line = "    \"" + std::string(laws.strength) + "\": {\"free\": [" + number(laws.weakest) + ", " +
             number(laws.strongest) + "], \"scale\": \"log\"},\n";
    else if (laws.attraction == "none" && std::ranges::any_of(of_bridge, is_key))
      continue;
    out += line;
  }
  return out;
}

nlohmann::ordered_json contact_of(const TargetLaws& laws) {
  nlohmann::ordered_json out{{"normal", laws.normal}, {"attraction", laws.attraction}};
  if (laws.attraction != "none") out["formation"] = "film";
  out["rolling_model"] = laws.rolling_model;
  out["friction_basis"] = laws.friction_basis;
  return out;
}

}  // namespace pastefit
