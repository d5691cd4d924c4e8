#include "core/apparatus/specimen.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/apparatus/dimension.h"
#include "core/apparatus/field_checker.h"
#include "core/laws/constants.h"
#include "core/laws/table.h"
#include "core/random.h"
#include "core/step/time_step.h"

namespace pastefit {

namespace {

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
  // Tolerance for rounding in the conversion to a, b, c.
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

/// Share of a normal distribution within the bounds.
double share_between_bounds(const GrainSizes& sizes) {
  const auto below = [&](double radius) {
    return 0.5 * std::erfc((sizes.radius_m - radius) / (sizes.standard_deviation_m * std::numbers::sqrt2));
  };
  return below(sizes.largest_m) - below(sizes.smallest_m);
}

}  // namespace

double largest_radius(const GrainSizes& sizes) {
  return sizes.distribution == SizeDistribution::mono ? sizes.radius_m : sizes.largest_m;
}

double draw_radius(const GrainSizes& sizes, std::uint64_t seed, std::uint64_t n) {
  switch (sizes.distribution) {
    case SizeDistribution::mono:
      return sizes.radius_m;
    case SizeDistribution::uniform:
      return RandomStream(seed, "grain-radius").uniform(n, sizes.smallest_m, sizes.largest_m);
    case SizeDistribution::normal: {
      const RandomStream draws(seed, "grain-radius");
      constexpr std::uint64_t kTries = 1000;
      for (std::uint64_t t = 0; t < kTries; ++t) {
        const double r = sizes.radius_m + sizes.standard_deviation_m * draws.normal(kTries * n + t);
        if (r >= sizes.smallest_m && r <= sizes.largest_m) return r;
      }
      return std::clamp(sizes.radius_m, sizes.smallest_m, sizes.largest_m);
    }
  }
  return sizes.radius_m;
}

namespace {

/// Assumed solid fraction of the filled mould; the density of grains follows from the filling, which is not known here.
constexpr double kFilledShare = 0.6;

void check_viscosity(FieldChecker& check, const Specimen& specimen) {
  const double viscosity = specimen.contact.bridge.viscosity_pa_s, radius = specimen.grains.radius_m;
  check.require(viscosity >= 0, "contact.bridge.viscosity_pa_s", "is " + FieldChecker::text(viscosity) + " Pa s",
                "give 0 or more");
  if (!(viscosity > 0)) return;
  check.require(specimen.contact.bridge.shape != BridgeShape::none, "contact.bridge.viscosity_pa_s",
                "is the viscosity of a bridge, and there is none", "give 0, or a \"shape\" of the bridge");
  const double mass = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3) * specimen.bulk_density_kg_m3 / kFilledShare;
  const double largest = largest_viscosity(specimen.contact, radius, mass);
  check.require(!(viscosity > largest), "contact.bridge.viscosity_pa_s",
                "is " + FieldChecker::text(viscosity) + " Pa s, which would need time steps of less than a twentieth",
                "give at most " + FieldChecker::text(largest) +
                    " Pa s; larger or stiffer grains (youngs_modulus_pa) can have more");
}

}  // namespace

void check_wall(FieldChecker& check, const WallContact& wall, const std::string& name) {
  const auto at = [&](const char* field) { return name + "." + field; };
  check.range(at("youngs_modulus_pa"), wall.youngs_modulus_pa, 1e4, 1e13, "Pa");
  check.range(at("poissons_ratio"), wall.poissons_ratio, 0, 0.49, "");
  check_dimensions(check, wall, surface_dimensions, name + ".");
}

void check_specimen(FieldChecker& check, const Specimen& specimen) {
  const GrainSizes& sizes = specimen.grains;
  const double radius = sizes.radius_m;
  check.range("grains.radius_m", radius, 1e-5, 1, "m");
  if (sizes.distribution != SizeDistribution::mono) {
    check.require(sizes.smallest_m > 0 && sizes.smallest_m <= radius && radius <= sizes.largest_m, "grains",
                  "smallest, mean and largest radius are not in order", "give 0 < smallest <= radius <= largest");
    check.require(sizes.largest_m <= 20 * sizes.smallest_m, "grains",
                  "the largest grain is more than 20 times the smallest", "narrow the distribution");
  }
  if (sizes.distribution == SizeDistribution::normal) {
    check.range("grains.standard_deviation_m", sizes.standard_deviation_m, 1e-6 * radius, radius, "m");
    constexpr double kFewest = 0.01;
    const double left = share_between_bounds(sizes);
    check.require(!(left < kFewest), "grains.standard_deviation_m",
                  "leaves " + FieldChecker::text(100 * left) + " % of the grains between smallest and largest",
                  "widen the bounds, narrow the distribution, or give \"mono\" or \"uniform\"");
  }
  check.range("bulk_density_kg_m3", specimen.bulk_density_kg_m3, 100, 20000, "kg/m^3");

  const ContactModel& contact = specimen.contact;
  check.range("contact.youngs_modulus_pa", contact.youngs_modulus_pa, 1e4, 1e12, "Pa");
  check.range("contact.poissons_ratio", contact.poissons_ratio, 0, 0.49, "");
  check.range("contact.restitution", contact.restitution, 0.001, 1, "");
  check.range("contact.friction", contact.friction, 0, 10, "");
  check.range("contact.rolling_friction", contact.rolling_friction, 0, 10, "");
  check.range("contact.surface_energy_j_m2", contact.surface_energy_j_m2, 0, 1e6, "J/m^2");
  check.range("contact.cohesion_energy_density_pa", contact.cohesion_energy_density_pa, 0, 1e12, "J/m^3");
  check.range("contact.plasticity_ratio", contact.plasticity_ratio, 0, kMostPlastic, "");
  check.range("contact.adhesion_ratio", contact.adhesion_ratio, 0, kMostAdhesive, "");
  check.require(go_together(contact.normal, contact.bridge.shape), "contact.bridge.shape",
                "is a bridge beside a law of the overlap that has none",
                "give \"none\", or \"normal\": \"hertz\" or \"jkr\"");
  if (contact.cohesion_n) check.range("contact.cohesion_n", *contact.cohesion_n, 0, 1e9, "N");
  check_bridge(check, contact.bridge, radius);
  if (contact.youngs_modulus_pa > 0 && contact.poissons_ratio < 1 && radius > 0) {
    // Beyond this overlap, second neighbours touch and contact laws of pairs are invalid.
    constexpr double kMostSqueezed = 0.1;
    constexpr double kStiffestPa = 1e11;  // largest modulus in a study
    const double squeezed = resting_overlap(contact, radius);
    const double needed_pa = contact.youngs_modulus_pa * std::pow(squeezed / kMostSqueezed, 1.5);
    const bool in_reach = needed_pa <= kStiffestPa;
    check.require(!(squeezed > kMostSqueezed), "contact.youngs_modulus_pa",
                  "is " + FieldChecker::text(contact.youngs_modulus_pa) +
                      " Pa: attraction presses the grains into each other by " + FieldChecker::text(100 * squeezed) +
                      " % of their diameter",
                  (in_reach ? "give at least " + FieldChecker::text(needed_pa) + " Pa, or less strength"
                            : "give less strength, which no stiffness up to " + FieldChecker::text(kStiffestPa) +
                                  " Pa would carry") +
                      ": 10 % is the most that is carried");
    check_viscosity(check, specimen);
  }
}

namespace {

constexpr double kLoosest = 2.15;  // spacing of the lattice over the largest radius

/// Adds a grain at this place.
void add_grain(LooseGrains& grains, const Vec3& place, double radius) {
  grains.centres.push_back(place);
  grains.radii.push_back(radius);
  grains.solid_volume_m3 += sphere_volume_m3(radius);
}

}  // namespace

LooseGrains pour(const GrainSizes& sizes, std::uint64_t seed, double enough, double widest,
                 const std::function<double(double)>& inner_radius) {
  const double largest = largest_radius(sizes);
  const double spacing = kLoosest * largest;
  const double jitter = 0.5 * spacing - largest;
  const RandomStream place(seed, "pour-position");
  const int across = static_cast<int>(widest / spacing) + 1;
  LooseGrains grains;
  std::uint64_t n = 0;
  for (int layer = 0; grains.solid_volume_m3 < enough; ++layer) {
    const double z = spacing * (layer + 0.5);
    const double room = std::min(inner_radius(z - jitter), inner_radius(z + jitter)) - 1.01 * largest;
    for (int iy = -across; iy <= across; ++iy)
      for (int ix = -across; ix <= across; ++ix) {
        if (grains.solid_volume_m3 >= enough) continue;
        const double shift = layer % 2 == 0 ? 0.0 : 0.5;
        const Vec3 p{spacing * (ix + shift) + place.uniform(3 * n, -jitter, jitter),
                     spacing * (iy + shift) + place.uniform(3 * n + 1, -jitter, jitter),
                     z + place.uniform(3 * n + 2, -jitter, jitter)};
        if (p.x * p.x + p.y * p.y > room * room) continue;
        add_grain(grains, p, draw_radius(sizes, seed, n));
        ++n;
      }
  }
  return grains;
}

LooseGrains pour(const GrainSizes& sizes, std::uint64_t seed, double enough, const OpenBox& box) {
  const double largest = largest_radius(sizes), spacing = kLoosest * largest;
  const double jitter = 0.5 * spacing - largest;
  const double room = box.width_m - 2.02 * largest - 2 * jitter;  // width of the lattice
  const int along = static_cast<int>(box.length_m / spacing), across = static_cast<int>(room / spacing) + 1;
  const double step_x = box.length_m / along, step_y = across > 1 ? room / (across - 1) : 0;
  const RandomStream place(seed, "pour-position");
  LooseGrains grains;
  std::uint64_t n = 0;
  for (int layer = 0; grains.solid_volume_m3 < enough; ++layer)
    for (int iy = 0; iy < across; ++iy)
      for (int ix = 0; ix < along && grains.solid_volume_m3 < enough; ++ix, ++n) {
        const double shift = layer % 2 == 0 ? 0.0 : 0.5;
        const auto off = [&](std::uint64_t k) { return place.uniform(3 * n + k, -jitter, jitter); };
        const Vec3 p{step_x * (ix + shift) + off(0), step_y * iy - 0.5 * room + off(1),
                     box.floor_m + spacing * (layer + 0.5) + off(2)};
        add_grain(grains, p, draw_radius(sizes, seed, n));
      }
  return grains;
}

double sphere_volume_m3(double r) {
  return 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

double top_of(const LooseGrains& grains) {
  double top = 0;
  for (std::size_t i = 0; i < grains.centres.size(); ++i) top = std::max(top, grains.centres[i].z + grains.radii[i]);
  return top;
}

}  // namespace pastefit
