#include <cstdlib>
#include <map>

#include "contact_law.h"

namespace pastefit_lammps {

namespace {

/// Words and numbers by name, and what is wrong with them.
class Words {
 public:
  explicit Words(const std::vector<std::string>& words) {
    if (words.size() % 2 != 0) fault("'" + words.back() + "' has no value");
    for (std::size_t i = 0; i + 1 < words.size(); i += 2)
      if (!values_.emplace(words[i], words[i + 1]).second) fault("'" + words[i] + "' is named twice");
  }

  bool has(const std::string& name) const { return values_.count(name) > 0; }

  /// A number in (low, high], or [low, high] where `least` is admitted.
  void number(const std::string& name, double& to, double low, double high, bool least = true) {
    std::string text;
    if (!take(name, text)) return;
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end || !(value >= low && value <= high) || (value == low && !least))
      fault("'" + name + " " + text + "' is not in its range");
    to = value;
  }

  std::string choice(const std::string& name, const std::vector<std::string>& choices) {
    std::string text, list;
    if (!take(name, text)) return text;
    for (const auto& one : choices) {
      if (one == text) return text;
      list += " " + one;
    }
    fault("'" + name + " " + text + "': one of" + list);
    return text;
  }

  std::string faults() {
    for (const auto& one : values_) fault("'" + one.first + "' is not known here");
    return faults_;
  }
  void fault(const std::string& text) { faults_ += "\n  " + text; }

 private:
  bool take(const std::string& name, std::string& text) {
    const auto found = values_.find(name);
    if (found == values_.end()) {
      fault("'" + name + "' is missing");
      return false;
    }
    text = found->second;
    values_.erase(found);
    return true;
  }

  std::map<std::string, std::string> values_;
  std::string faults_;
};

constexpr double kMost = 1e300;

}  // namespace

std::string read_law(const std::vector<std::string>& all, Law& law) {
  Words words(all);
  words.number("reference_radius_m", law.reference_radius_m, 0, 10, false);
  words.number("youngs_modulus_pa", law.youngs_modulus_pa, 0, 1e13, false);
  words.number("poissons_ratio", law.poissons_ratio, 0, 0.4999);
  words.number("restitution", law.restitution, 0, 1, false);
  words.number("friction", law.friction, 0, 10);
  words.number("rolling_friction", law.rolling_friction, 0, 10);
  law.rolling = words.choice("rolling", {"none", "spring_dashpot", "constant_torque"});
  law.friction_basis = words.choice("friction_basis", {"elastic", "total", "net"});
  words.number("cohesion_n", law.cohesion_n, 0, kMost);
  law.bridge = words.choice("bridge", {"none", "polynomial", "linear", "exponential", "capillary"});
  law.normal = words.has("normal") ? words.choice("normal", {"hertz", "epa", "luding"}) : "hertz";
  if (law.normal != "hertz") {
    words.number("plasticity_ratio", law.plasticity_ratio, 0, 0.98);
    words.number("adhesion_ratio", law.adhesion_ratio, 0, 20);
    if (law.bridge != "none") words.fault("'normal " + law.normal + "' needs 'bridge none'");
  }
  if (law.bridge == "capillary") {
    words.number("liquid_volume_m3", law.liquid_volume_m3, 0, 1, false);
    words.number("surface_tension_n_m", law.surface_tension_n_m, 0, kMost);
    words.number("contact_angle_rad", law.contact_angle_rad, 0, 1.5707);
  } else if (law.bridge != "none") {
    words.number("c_n", law.c_n, 0, kMost);
    words.number("d_c_m", law.d_c_m, -10, -1e-12);
  }
  if (law.bridge == "polynomial") {
    words.number("a_n_m2", law.a_n_m2, -kMost, kMost);
    words.number("b_n_m", law.b_n_m, 0, kMost);
  }
  if (law.bridge != "none") {
    law.formation = words.choice("formation", {"film", "touch"});
    if (law.formation == "film") words.number("offset_m", law.offset_m, 0, 10);
    if (words.has("viscosity_pa_s")) words.number("viscosity_pa_s", law.viscosity_pa_s, 0, kMost);
  }
  return words.faults();
}

std::string read_wall_law(const std::vector<std::string>& all, WallLaw& wall) {
  Words words(all);
  words.number("youngs_modulus_pa", wall.youngs_modulus_pa, 0, 1e13, false);
  words.number("poissons_ratio", wall.poissons_ratio, 0, 0.4999);
  words.number("restitution", wall.restitution, 0, 1, false);
  words.number("friction", wall.friction, 0, 10);
  words.number("rolling_friction", wall.rolling_friction, 0, 10);
  words.number("cohesion_factor", wall.cohesion_factor, 0, 10);
  return words.faults();
}

std::string read_hinge(const std::vector<std::string>& all, Hinge& hinge) {
  Words words(all);
  words.number("mass_kg", hinge.mass_kg, 0, kMost, false);
  words.number("inertia_kg_m2", hinge.inertia_kg_m2, 0, kMost, false);
  words.number("arm_m", hinge.arm_m, 0, 1000);
  words.number("x_m", hinge.x_m, -1000, 1000);
  words.number("z_m", hinge.z_m, -1000, 1000);
  words.number("angle_rad", hinge.angle_rad, -1.5707, 0);
  return words.faults();
}

}  // namespace pastefit_lammps
