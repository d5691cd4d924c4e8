#include "tests/stability/stress_case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>

#include "calibrate/search/screening.h"
#include "core/laws/constants.h"

namespace pastefit {

namespace {

/// Coordinates of the box. The first six are those of the corners.
enum Axis {
  modulus,
  attraction,
  lift_velocity,
  restitution,
  size_ratio,
  friction,
  rolling_friction,
  rolling_model,
  bridge_shape,
  rupture_gap,
  offset,
  formation,
  friction_basis,
  plate_angle,
  enlargement,
  rupture_force,
  curvature,
  poissons_ratio,
  wall_friction,
  wall_cohesion,
  overlap_cohesion,
  axes
};
constexpr int kCornerAxes = 6;
static_assert(kCorners == 1 << kCornerAxes);

// Hägermann cone with some 350 grains, and a lift of 6 s at the slowest.
constexpr Mould kMould{0.050, 0.035, 0.060};
constexpr double kVolumeRadius = 0.005;  // of the grain of mean volume, so that there are as many whatever their sizes
constexpr double kTable = 0.300;
constexpr double kSolidFraction = 0.6;  // to know a grain's weight before the mould is filled

double linear(double u, double lower, double upper) {
  return lower + u * (upper - lower);
}

double logarithmic(double u, double lower, double upper) {
  return lower * std::pow(upper / lower, u);
}

/// Zero for a share of the axis, then the rest of it stretched to 0 .. 1.
double beyond(double u, double share) {
  return std::max(u - share, 0.0) / (1 - share);
}

int one_of(double u, int count) {
  return std::min(static_cast<int>(u * count), count - 1);
}

/// A bridge with force c at touch and rupture at -gap, whatever its shape.
Bridge bridge_of(const UnitPoint& u, double radius, double c, double gap) {
  Bridge bridge;
  bridge.shape = static_cast<BridgeShape>(one_of(u[bridge_shape], 5));
  bridge.formation = static_cast<BridgeFormation>(one_of(u[formation], 2));
  bridge.offset_m = u[offset] * radius;
  if (bridge.shape == BridgeShape::capillary) {
    bridge.contact_angle_rad = linear(u[curvature], 0, 1);
    bridge.surface_tension_n_m = c / (2 * std::numbers::pi * radius * std::cos(bridge.contact_angle_rad));
    // Volume whose bridge ruptures at the gap: x + 0.1 x^2/R = gap/(1 + theta/2), x its cube root.
    const double reach = gap / radius / (1 + 0.5 * bridge.contact_angle_rad);
    const double x = std::clamp((std::sqrt(1 + 0.4 * reach) - 1) / 0.2, 1.01e-3, 1.0);
    bridge.liquid_volume_m3 = std::pow(x * radius, 3);
    return bridge;
  }
  const double left = u[rupture_force], k = linear(u[curvature], -1, 1);
  bridge.c_n = c;
  bridge.d_c_m = -gap;
  bridge.a_n_m2 = k * (1 - left) * c / (gap * gap);
  bridge.b_n_m = (1 - left) * (1 + k) * c / gap;
  return bridge;
}

StressCase case_at(const UnitPoint& u, int number) {
  StressCase stress;
  stress.number = number;
  SlumpTest& test = stress.test;
  test.mould = kMould;
  test.table_length_m = kTable;
  test.reading.probe_diameter_m = 0.02;
  test.lift_velocity_m_s = logarithmic(u[lift_velocity], 0.01, 1);
  test.packing_seed = static_cast<std::uint64_t>(number) + 1;
  if (u[plate_angle] > 0.4) {
    stress.plate_deg = logarithmic(beyond(u[plate_angle], 0.4), 1, 44.9);
    test.drop = DropPlate{kTable, 1.0, kTable * std::sin(stress.plate_deg * std::numbers::pi / 180), 0.3};
  }

  stress.size_ratio = logarithmic(u[size_ratio], 1, 10);
  const double q = stress.size_ratio;
  test.grains.smallest_m = kVolumeRadius / std::cbrt((1 + q) * (1 + q * q) / 4);
  test.grains.largest_m = q * test.grains.smallest_m;
  const double radius = test.grains.radius_m = 0.5 * (test.grains.smallest_m + test.grains.largest_m);
  if (stress.size_ratio > 1) test.grains.distribution = SizeDistribution::uniform;
  stress.enlarged = 0.1 * beyond(u[enlargement], 0.5);

  ContactModel& contact = test.contact;
  contact.youngs_modulus_pa = logarithmic(u[modulus], 1e5, 1e9);
  contact.poissons_ratio = linear(u[poissons_ratio], 0, 0.45);
  contact.restitution = linear(u[restitution], 0.01, 0.99);
  contact.friction = linear(u[friction], 0, 2);
  contact.rolling_friction = u[rolling_friction];
  contact.rolling = static_cast<RollingModel>(one_of(u[rolling_model], 3));
  contact.friction_basis = static_cast<FrictionBasis>(one_of(u[friction_basis], 2));

  const double weight =
      test.bulk_density_kg_m3 / kSolidFraction * 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3) * 9.81;
  stress.weights = u[attraction] > 0.1 ? logarithmic(beyond(u[attraction], 0.1), 0.1, 100) : 0;
  const double c = stress.weights * weight;
  stress.gap_ratio = logarithmic(u[rupture_gap], 1e-3, 1);
  if (c > 0) contact.bridge = bridge_of(u, radius, c, stress.gap_ratio * radius);
  // Without a bridge, and for some others, the cohesion in overlap stands on its own.
  if (contact.bridge.shape == BridgeShape::none) contact.cohesion_n = c;
  if (u[overlap_cohesion] > 0.7) contact.cohesion_n = 2 * beyond(u[overlap_cohesion], 0.7) * c;

  // Softer grains than carry the attraction are no admissible test.
  constexpr double kMostSqueezed = 0.0999;
  const double softness = std::pow(resting_overlap(contact, radius) / kMostSqueezed, 1.5);
  if (softness > 1) contact.youngs_modulus_pa *= softness;

  test.mould_wall = {1e9, 0.3, contact.restitution, 0.5 * u[wall_friction], 0.1 * u[rolling_friction], 0};
  test.table_wall = {1e9, 0.3, contact.restitution, 2 * u[wall_friction], u[rolling_friction], 0};
  test.mould_wall.cohesion_factor = test.table_wall.cohesion_factor = beyond(u[wall_cohesion], 0.5);
  return stress;
}

UnitPoint corner(int number, std::uint64_t seed) {
  UnitPoint u(static_cast<int>(axes));
  for (int k = 0; k < axes; ++k) {
    const std::uint64_t drawn = hash_of(seed, static_cast<std::uint64_t>(number * axes + k));
    u[k] = k < kCornerAxes ? (number >> k) & 1 : std::ldexp(static_cast<double>(drawn >> 11), -53);
  }
  return u;
}

}  // namespace

std::vector<StressCase> stress_cases(int first, int count, std::uint64_t seed) {
  const std::vector<UnitPoint> points = screening_points(axes, std::max(first + count - kCorners, 0), seed);
  std::vector<StressCase> cases;
  for (int number = first; number < first + count; ++number)
    cases.push_back(case_at(number < kCorners ? corner(number, seed) : points[number - kCorners], number));
  return cases;
}

SlumpTest small_cone(int number, double grain_radius_m) {
  SlumpTest test;
  test.mould = {0.050, 0.035, 0.060};
  test.table_length_m = 0.300;
  test.reading.probe_diameter_m = 0.02;
  test.lift_velocity_m_s = 0.3;
  test.packing_seed = static_cast<std::uint64_t>(number) + 1;
  test.grains.radius_m = test.grains.smallest_m = test.grains.largest_m = grain_radius_m;
  return test;
}

std::vector<std::pair<std::string, std::string>> inputs_of(const StressCase& stress) {
  std::vector<std::pair<std::string, std::string>> inputs;
  const auto add = [&](const char* name, double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    inputs.emplace_back(name, text);
  };
  const auto add_name = [&](const char* name, auto value, auto... names) {
    const char* const all[] = {names...};
    inputs.emplace_back(name, all[static_cast<int>(value)]);
  };
  const SlumpTest& test = stress.test;
  const ContactModel& contact = test.contact;
  const Bridge& bridge = contact.bridge;
  add("youngs_modulus_pa", contact.youngs_modulus_pa);
  add("poissons_ratio", contact.poissons_ratio);
  add("restitution", contact.restitution);
  add("friction", contact.friction);
  add("rolling_friction", contact.rolling_friction);
  add_name("rolling", contact.rolling, "none", "spring_dashpot", "constant_torque");
  add_name("friction_basis", contact.friction_basis, "elastic", "total");
  add("c_weights", stress.weights);
  add("cohesion_n", contact.cohesion_n.value_or(bridge.c_n));
  add_name("bridge", bridge.shape, "none", "polynomial", "linear", "exponential", "capillary");
  add_name("formation", bridge.formation, "film", "touch");
  add("gap_ratio", stress.gap_ratio);
  add("a_n_m2", bridge.a_n_m2);
  add("b_n_m", bridge.b_n_m);
  add("c_n", bridge.c_n);
  add("d_c_m", bridge.d_c_m);
  add("offset_m", bridge.offset_m);
  add("liquid_volume_m3", bridge.liquid_volume_m3);
  add("surface_tension_n_m", bridge.surface_tension_n_m);
  add("contact_angle_rad", bridge.contact_angle_rad);
  add("smallest_m", test.grains.smallest_m);
  add("largest_m", test.grains.largest_m);
  add("lift_velocity_m_s", test.lift_velocity_m_s);
  add("plate_deg", stress.plate_deg);
  add("enlarged", stress.enlarged);
  add("mould_friction", test.mould_wall.friction);
  add("table_friction", test.table_wall.friction);
  add("wall_cohesion_factor", test.table_wall.cohesion_factor);
  add("packing_seed", static_cast<double>(test.packing_seed));
  return inputs;
}

}  // namespace pastefit
