#include "core/rigs/slump/slump_test.h"

#include <cmath>
#include <numbers>
#include <string>

#include "core/laws/constants.h"

namespace pastefit {

namespace {

/// Collects faults of numbers that are not finite or not in their range.
class FieldChecker {
 public:
  void range(const char* where, double value, double lower, double upper, const char* unit) {
    if (std::isfinite(value) && value >= lower && value <= upper) return;
    faults_.push_back({where, "is " + text(value) + " " + unit,
                       "give a number from " + text(lower) + " to " + text(upper) + " " + unit});
  }
  void require(bool holds, const char* where, std::string what, std::string remedy) {
    if (!holds) faults_.push_back({where, std::move(what), std::move(remedy)});
  }
  Faults take() { return std::move(faults_); }

  static std::string text(double value) {
    std::string s(32, '\0');
    s.resize(std::snprintf(s.data(), s.size(), "%.6g", value));
    return s;
  }

 private:
  Faults faults_;
};

void check_wall(FieldChecker& check, const WallContact& wall, const std::string& name) {
  const auto at = [&](const char* field) { return name + "." + field; };
  check.range(at("youngs_modulus_pa").c_str(), wall.youngs_modulus_pa, 1e4, 1e13, "Pa");
  check.range(at("poissons_ratio").c_str(), wall.poissons_ratio, 0, 0.49, "");
  check.range(at("restitution").c_str(), wall.restitution, 0.001, 1, "");
  check.range(at("friction").c_str(), wall.friction, 0, 10, "");
  check.range(at("rolling_friction").c_str(), wall.rolling_friction, 0, 10, "");
  check.range(at("cohesion_factor").c_str(), wall.cohesion_factor, 0, 10, "");
}

void check_bridge(FieldChecker& check, const Bridge& bridge, double radius) {
  if (bridge.shape == BridgeShape::none) return;
  check.range("contact.bridge.offset_m", bridge.offset_m, 0, 2 * radius, "m");
  if (bridge.shape == BridgeShape::capillary) {
    check.range("contact.bridge.liquid_volume_m3", bridge.liquid_volume_m3, 1e-10 * std::pow(radius, 3),
                std::pow(radius, 3), "m^3");
    check.range("contact.bridge.surface_tension_n_m", bridge.surface_tension_n_m, 0, 1e7, "N/m");
    check.range("contact.bridge.contact_angle_rad", bridge.contact_angle_rad, 0, 0.5 * std::numbers::pi, "rad");
    return;
  }
  check.range("contact.bridge.c_n", bridge.c_n, 0, 1e9, "N");
  check.range("contact.bridge.d_c_m", bridge.d_c_m, -2 * radius, -1e-6 * radius, "m");
  if (bridge.shape != BridgeShape::polynomial) return;
  // Rounding in converting coordinates to a, b, c must not count as a fault.
  const double slack = 1e-9 * bridge.c_n;
  const double gap = bridge.d_c_m;
  const double at_rupture = (bridge.a_n_m2 * gap + bridge.b_n_m) * gap + bridge.c_n;
  check.require(bridge.b_n_m * -gap >= -slack, "contact.bridge.b_n_m",
                "is " + FieldChecker::text(bridge.b_n_m) + " N/m: the attraction would grow with distance",
                "give b >= 0");
  check.require((bridge.b_n_m + 2 * bridge.a_n_m2 * gap) * -gap >= -slack, "contact.bridge.a_n_m2",
                "is " + FieldChecker::text(bridge.a_n_m2) + " N/m^2: the attraction would grow again before rupture",
                "give a with b + 2 a d_c >= 0, at most " + FieldChecker::text(-bridge.b_n_m / (2 * gap)) + " N/m^2");
  check.require(at_rupture >= -slack, "contact.bridge",
                "the force at rupture is " + FieldChecker::text(at_rupture) + " N, a repulsion",
                "choose a, b, c, d_c with a d_c^2 + b d_c + c >= 0");
}

}  // namespace

double volume_m3(const Mould& mould) {
  const double rb = mould.base_radius_m, rt = mould.top_radius_m;
  return std::numbers::pi * mould.height_m / 3 * (rb * rb + rb * rt + rt * rt);
}

Faults validate(const SlumpTest& test) {
  FieldChecker check;
  const GrainSizes& sizes = test.grains;
  const double radius = sizes.radius_m;
  check.range("grains.radius_m", radius, 1e-5, 1, "m");
  double largest = radius;
  if (sizes.distribution != SizeDistribution::mono) {
    largest = sizes.largest_m;
    check.require(sizes.smallest_m > 0 && sizes.smallest_m <= radius && radius <= sizes.largest_m, "grains",
                  "smallest, mean and largest radius are not in order", "give 0 < smallest <= radius <= largest");
    check.require(sizes.largest_m <= 20 * sizes.smallest_m, "grains",
                  "the largest grain is more than 20 times the smallest", "narrow the distribution");
  }
  if (sizes.distribution == SizeDistribution::normal)
    check.range("grains.standard_deviation_m", sizes.standard_deviation_m, 1e-6 * radius, radius, "m");

  const Mould& mould = test.mould;
  check.range("mould.base_radius_m", mould.base_radius_m, 1e-3, 2, "m");
  check.range("mould.top_radius_m", mould.top_radius_m, 1e-3, 2, "m");
  check.range("mould.height_m", mould.height_m, 1e-3, 2, "m");
  check.require(mould.top_radius_m <= mould.base_radius_m, "mould.top_radius_m",
                "is wider than the base: the mould could not be lifted off", "give top <= base");
  constexpr double kGrainsAcross = 2.5;
  const double narrow = mould.top_radius_m < mould.height_m / 2 ? mould.top_radius_m : mould.height_m / 2;
  check.require(narrow >= kGrainsAcross * largest, "grains.radius_m",
                "is " + FieldChecker::text(largest) + " m (largest), but the mould is only " +
                    FieldChecker::text(2 * narrow) +
                    " m across: a mould of a few grains says nothing about a continuum",
                "take grains of at most " + FieldChecker::text(narrow / kGrainsAcross) + " m radius");
  check.range("lift_velocity_m_s", test.lift_velocity_m_s, 1e-3, 10, "m/s");
  check.range("table_length_m", test.table_length_m, 2 * mould.base_radius_m, 10, "m");
  check.range("reading.probe_diameter_m", test.reading.probe_diameter_m, radius, 2 * mould.base_radius_m, "m");
  check.range("reading.sag_window_m", test.reading.sag_window_m, 4 * radius, test.table_length_m, "m");
  check.range("bulk_density_kg_m3", test.bulk_density_kg_m3, 100, 20000, "kg/m^3");
  if (test.drop) {
    check.range("drop.length_m", test.drop->length_m, 2 * mould.base_radius_m, 10, "m");
    check.range("drop.mass_kg", test.drop->mass_kg, 0.1, 1000, "kg");
    check.range("drop.lift_height_m", test.drop->lift_height_m, 1e-4, 0.99 * test.drop->length_m, "m");
    check.range("drop.lift_duration_s", test.drop->lift_duration_s, 0.01, 100, "s");
  }

  const ContactModel& contact = test.contact;
  check.range("contact.youngs_modulus_pa", contact.youngs_modulus_pa, 1e4, 1e12, "Pa");
  check.range("contact.poissons_ratio", contact.poissons_ratio, 0, 0.49, "");
  check.range("contact.restitution", contact.restitution, 0.001, 1, "");
  check.range("contact.friction", contact.friction, 0, 10, "");
  check.range("contact.rolling_friction", contact.rolling_friction, 0, 10, "");
  check.range("contact.surface_energy_j_m2", contact.surface_energy_j_m2, 0, 1e6, "J/m^2");
  if (contact.cohesion_n) check.range("contact.cohesion_n", *contact.cohesion_n, 0, 1e9, "N");
  check_bridge(check, contact.bridge, radius);
  if (contact.youngs_modulus_pa > 0 && contact.poissons_ratio < 1 && radius > 0) {
    // Beyond it neighbours of neighbours meet, and contact laws of touching spheres mean nothing.
    constexpr double kMostSqueezed = 0.1;
    const double squeezed = squeeze(contact, radius);
    check.require(!(squeezed > kMostSqueezed), "contact.youngs_modulus_pa",
                  "is " + FieldChecker::text(contact.youngs_modulus_pa) +
                      " Pa: attraction presses the grains into each other by " + FieldChecker::text(100 * squeezed) +
                      " % of their diameter",
                  "give at least " +
                      FieldChecker::text(contact.youngs_modulus_pa * std::pow(squeezed / kMostSqueezed, 1.5)) +
                      " Pa, or less strength: 10 % is the most that is carried");
  }
  check_wall(check, test.mould_wall, "mould_wall");
  check_wall(check, test.table_wall, "table_wall");
  return check.take();
}

}  // namespace pastefit
