#include "core/laws/constants.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/laws/table.h"

namespace pastefit {

namespace {

constexpr double kRounding = 1e-9;  // of a force: tolerance for rounding

double shear_modulus(double youngs_modulus, double poissons_ratio) {
  return youngs_modulus / (2 * (1 + poissons_ratio));
}

void set_elastic(PairConstants& pair, double e1, double nu1, double e2, double nu2, double restitution) {
  const double e_star = 1 / ((1 - nu1 * nu1) / e1 + (1 - nu2 * nu2) / e2);
  const double g_star = 1 / ((2 - nu1) / shear_modulus(e1, nu1) + (2 - nu2) / shear_modulus(e2, nu2));
  pair.hertz = 4.0 / 3.0 * e_star;
  pair.normal_stiffness = 2 * e_star;
  pair.sqrt_normal_stiffness = std::sqrt(pair.normal_stiffness);
  pair.tangential_ratio = 4 * g_star / e_star;
  pair.damping = 2 * std::sqrt(5.0 / 6.0) * damping_ratio(restitution);
  pair.lost_share = 1 - restitution * restitution;
  pair.tangential_damping = pair.damping * std::sqrt(pair.tangential_ratio);
  pair.spin_damping_share = (kSurfaceLightness - 1) * std::sqrt(pair.tangential_ratio);
}

void set_friction(PairConstants& pair, double friction, FrictionBasis basis) {
  pair.friction = friction;
  pair.friction_of_total = basis != FrictionBasis::elastic;
  pair.friction_reserve = basis == FrictionBasis::net ? 0 : 1;
  // Of a tangential force T the spring's own normal force is T^2/(4 S_t d): a share x of the repulsion where T is mu
  // times the repulsion. T/repulsion = mu (1 + x (T/(mu repulsion))^2) in two iterations, as in `act`.
  const double x = std::min(friction * friction / (6 * pair.tangential_ratio), 0.25);
  pair.slip_limit = friction * (1 + x * (1 + x) * (1 + x));
}

/// `levers`: (r/R*)^2, 4 for equal grains and 1 for a grain on a wall.
void set_rolling(PairConstants& pair, double rolling_friction, double levers) {
  pair.rolling_friction = rolling_friction;
  pair.roll_stiffness_share = 2.25 * rolling_friction * rolling_friction / 0.4;
  pair.roll_damping = 0.6 * std::sqrt(1.4 * 2.25) * rolling_friction;
  pair.spin_damping = pair.roll_damping / (levers * 0.4) / pair.spin_damping_share;  // I = 2/5 m r^2
}

void set_normal(PairConstants& pair, const ContactModel& grains, double share) {
  with_law(NormalLaws{}, grains.normal, [&](auto law) { law.set(pair, grains, share); });
}

void set_attraction(PairConstants& pair, const ContactModel& grains, double radius, double share, double shells) {
  const Bridge& bridge = grains.bridge;
  const double at_touch = attraction_at_touch(bridge, radius);
  pair.cohesion = share * grains.cohesion_n.value_or(at_touch);
  if (bridge.shape == BridgeShape::none || share == 0) return;
  pair.bridge_c = share * at_touch;
  pair.touch_excess = pair.bridge_c - pair.cohesion;
  pair.passes_over = std::fabs(pair.touch_excess) > kRounding * pair.bridge_c;
  pair.passage = kPassage * radius;
  pair.rupture_gap = rupture_gap(bridge, radius);
  pair.formation_gap = bridge.formation == BridgeFormation::film ? shells * bridge.offset_m : 0.0;
  pair.viscosity = 6 * std::numbers::pi * share * bridge.viscosity_pa_s;
  pair.roughness = kRoughness * radius;
  with_law(Attractions{}, bridge.shape, [&](auto law) { law.set(pair, bridge, radius, share); });
}

}  // namespace

double damping_ratio(double restitution) {
  const double ln = std::log(restitution);
  return -ln / std::sqrt(ln * ln + std::numbers::pi * std::numbers::pi);
}

double attraction_at_touch(const Bridge& bridge, double radius) {
  return with_law(Attractions{}, bridge.shape, [&](auto law) { return law.at_touch(bridge, radius); });
}

double rupture_gap(const Bridge& bridge, double radius) {
  return with_law(Attractions{}, bridge.shape, [&](auto law) { return law.rupture_gap(bridge, radius); });
}

double bridge_force(const Bridge& bridge, double radius, double overlap) {
  ContactModel model;
  model.bridge = bridge;
  const PairConstants pair = grain_pair(model, radius);
  return with_law(Attractions{}, bridge.shape, [&](auto law) {
    if constexpr (law.present) return law.at(pair, overlap, 1.0).force;
    return 0.0;
  });
}

PairConstants grain_pair(const ContactModel& grains, double reference_radius_m) {
  PairConstants pair;
  set_elastic(pair, grains.youngs_modulus_pa, grains.poissons_ratio, grains.youngs_modulus_pa, grains.poissons_ratio,
              grains.restitution);
  set_friction(pair, grains.friction, grains.friction_basis);
  set_rolling(pair, grains.rolling_friction, 4);
  pair.size_per_radius = 2 / reference_radius_m;
  set_normal(pair, grains, 1.0);
  set_attraction(pair, grains, reference_radius_m, 1.0, 2.0);
  return pair;
}

PairConstants wall_pair(const ContactModel& grains, const WallContact& wall, double reference_radius_m) {
  PairConstants pair;
  set_elastic(pair, grains.youngs_modulus_pa, grains.poissons_ratio, wall.youngs_modulus_pa, wall.poissons_ratio,
              wall.restitution);
  set_friction(pair, wall.friction, grains.friction_basis);
  set_rolling(pair, wall.rolling_friction, 1);
  pair.size_per_radius = 1 / reference_radius_m;
  set_normal(pair, grains, wall.cohesion_factor);
  set_attraction(pair, grains, reference_radius_m, wall.cohesion_factor, 1.0);
  return pair;
}

double resting_overlap(const ContactModel& grains, double radius) {
  const PairConstants pair = grain_pair(grains, radius);
  return with_law(NormalLaws{}, acting(grains.normal, pair),
                  [&](auto law) { return law.overlap_under(pair, 0.5 * radius, pair.cohesion); }) /
         (2 * radius);
}

}  // namespace pastefit
