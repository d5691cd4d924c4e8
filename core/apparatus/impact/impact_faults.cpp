#include <array>
#include <cmath>
#include <set>
#include <string>

#include "core/apparatus/impact/impact.h"
#include "core/laws/table.h"

namespace pastefit {

namespace {

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Collects faults of an impact.
class Checker {
 public:
  void positive(const std::string& where, double value) {
    require(std::isfinite(value) && value > 0, where, "is not a positive number", "give a number above 0");
  }
  void number(const std::string& where, const Vec3& value) {
    require(finite(value), where, "is not finite", "give three numbers");
  }
  void require(bool holds, const std::string& where, const char* what, const char* remedy) {
    if (!holds) faults.push_back({where, what, remedy});
  }
  Faults faults;
};

}  // namespace

Faults validate(const Impact& test) {
  Checker check;
  check.require(!test.grains.empty(), "grains", "is empty", "give at least one grain: the first is watched");
  check.positive("density_kg_m3", test.density_kg_m3);
  check.positive("reference_radius_m", test.reference_radius_m);
  check.positive("duration_s", test.duration_s);
  if (test.rebound_gap_m) check.positive("rebound_gap_m", *test.rebound_gap_m);
  check.positive("contact.youngs_modulus_pa", test.contact.youngs_modulus_pa);
  check.require(test.contact.restitution > 0 && test.contact.restitution <= 1, "contact.restitution", "is out of range",
                "give a number above 0 and at most 1");
  check.require(std::isfinite(test.contact.surface_energy_j_m2) && test.contact.surface_energy_j_m2 >= 0,
                "contact.surface_energy_j_m2", "is negative", "give a number of at least 0");
  check.require(std::isfinite(test.contact.cohesion_energy_density_pa) && test.contact.cohesion_energy_density_pa >= 0,
                "contact.cohesion_energy_density_pa", "is negative", "give a number of at least 0");
  check.require(test.contact.plasticity_ratio >= 0 && test.contact.plasticity_ratio <= kMostPlastic,
                "contact.plasticity_ratio", "is out of range", "give a number from 0 to 0.98");
  check.require(test.contact.adhesion_ratio >= 0 && test.contact.adhesion_ratio <= kMostAdhesive,
                "contact.adhesion_ratio", "is out of range", "give a number from 0 to 20");
  check.require(go_together(test.contact.normal, test.contact.bridge.shape), "contact.bridge.shape",
                "is a bridge beside a law of the overlap that has none",
                "give \"none\", or \"normal\": \"hertz\" or \"jkr\"");
  const Bridge& bridge = test.contact.bridge;
  if (bridge.shape != BridgeShape::none)
    check.require(rupture_gap(bridge, test.reference_radius_m) > 0, "contact.bridge", "never ruptures",
                  "give d_c < 0, or a liquid volume");
  std::set<std::array<double, 3>> centres;
  for (std::size_t i = 0; i < test.grains.size(); ++i) {
    const ImpactGrain& grain = test.grains[i];
    const std::string place = "grains[" + std::to_string(i) + "].";
    check.positive(place + "radius_m", grain.radius_m);
    check.number(place + "centre_m", grain.centre_m);
    check.number(place + "velocity_m_s", grain.velocity_m_s);
    check.number(place + "spin_rad_s", grain.spin_rad_s);
    check.require(!grain.turns_at_s || grain.held, place + "turns_at_s", "is given for a grain that is free",
                  "set held, or leave it out");
    const Vec3& centre = grain.centre_m;
    check.require(!finite(centre) || centres.insert({centre.x, centre.y, centre.z}).second, place + "centre_m",
                  "is the centre of another grain too", "put the grains apart");
  }
  for (std::size_t w = 0; w < test.walls.size(); ++w) {
    const ImpactWall& wall = test.walls[w];
    const std::string place = "walls[" + std::to_string(w) + "].";
    check.positive(place + "youngs_modulus_pa", wall.surface.youngs_modulus_pa);
    check.require(wall.surface.restitution > 0 && wall.surface.restitution <= 1, place + "restitution",
                  "is out of range", "give a number above 0 and at most 1");
    check.require(wall.turning_rad_s == 0 || !std::holds_alternative<Shell>(wall.shape), place + "turning_rad_s",
                  "turns a shell, which cannot turn", "turn a plane or a plate");
    if (!wall.rotor_mass_kg) continue;
    check.positive(place + "rotor_mass_kg", *wall.rotor_mass_kg);
    check.require(std::holds_alternative<Plate>(wall.shape), place + "rotor_mass_kg", "is given for no plate",
                  "only plates turn freely");
  }
  if (test.step == ImpactStep::per_contact) check.positive("steps_per_contact", test.steps_per_contact);
  if (test.step == ImpactStep::fixed) check.positive("step_s", test.step_s);
  return check.faults;
}

}  // namespace pastefit
