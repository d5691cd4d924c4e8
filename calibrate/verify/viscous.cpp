#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/verify/formulas.h"
#include "core/laws/constants.h"

namespace pastefit {

namespace {

// Closed forms of two grains, or a grain and a wall, with a viscous bridge, independent of the engine (core/laws). C_n
// = 6 pi mu R*^2, C_t = 6 pi mu R* (8/15 ln(R*/h) + 0.9588), h: gap; for a wall, its share of the attraction counts.
// Limits: the bridge's attraction is neglected, so it must be small. Requirements: a pair; an existing bridge. Errors:
// the gap becomes smaller than the roughness.

Fault too_near() {
  return outside("the pair comes nearer than the roughness");
}

/// C_n [N m/(m/s)].
double squeezing(const Impact& scene) {
  const double radius = pair_of(scene).radius;
  return 6 * std::numbers::pi * share_of(scene) * scene.contact.bridge.viscosity_pa_s * radius * radius;
}

double least_gap(const Impact& scene) {
  return kRoughness * pair_of(scene).radius * (scene.grains.size() > 1 ? 2 : 1);
}

/// Initial gap of two grains, or of a grain above a plane through the origin.
double first_gap(const Impact& scene) {
  const ImpactGrain& grain = scene.grains[0];
  if (scene.grains.size() < 2) return grain.centre_m.z - grain.radius_m;
  return norm(scene.grains[1].centre_m - grain.centre_m) - grain.radius_m - scene.grains[1].radius_m;
}

/// Velocity and spin of a grain of a pair in relative sliding at constant gap, after the test's duration: the sliding
/// velocity decays with the rate C_t (1/m* + sum of (r + h/2)^2/I).
struct Sheared {
  Vec3 velocity, spin;
};

Sheared sheared(const Impact& scene, std::size_t which) {
  const Approach a = pair_of(scene);
  const double gap = first_gap(scene);
  const double drag = squeezing(scene) / a.radius * (8.0 / 15 * std::log(a.radius / gap) + 0.9588);
  double lightness = 0;
  Vec3 sliding = scene.grains[0].velocity_m_s - scene.grains[1].velocity_m_s;
  for (const ImpactGrain& grain : scene.grains) {
    const double mass = mass_kg(scene, grain), lever = grain.radius_m + 0.5 * gap;
    lightness += 1 / mass + lever * lever / (0.4 * mass * grain.radius_m * grain.radius_m);
    sliding += cross(lever * grain.spin_rad_s, a.normal);
  }
  sliding = sliding - dot(sliding, a.normal) * a.normal;
  const Vec3 on_first = -(1 - std::exp(-drag * lightness * scene.duration_s)) / lightness * sliding;
  const ImpactGrain& grain = scene.grains[which];
  const double mass = mass_kg(scene, grain), lever = grain.radius_m + 0.5 * gap;
  const double inertia = 0.4 * mass * grain.radius_m * grain.radius_m;
  return {grain.velocity_m_s + (which == 0 ? 1 : -1) / mass * on_first,
          grain.spin_rad_s + lever / inertia * cross(a.normal, on_first)};
}

/// Speed of approach after the test's duration, without other forces: v = v0 - C_n/m* ln(h0/h), dh/dt = -v, by
/// integration over ln h.
Result<double> squeezed_speed(const Impact& scene, const FormulaArguments&) {
  const Approach a = pair_of(scene);
  const double start = first_gap(scene), slope = squeezing(scene) / a.mass;
  // With x = ln(h0/h): v = v0 - slope x, dt = h/v dx.
  constexpr int kSteps = 200000;
  const double farthest = std::log(start / least_gap(scene)), dx = farthest / kSteps;
  double time = 0;
  for (int n = 0; n < kSteps; ++n) {
    const double x = (n + 0.5) * dx, speed = a.speed - slope * x;
    if (!(speed > 0)) return 0.0;
    const double duration = start * std::exp(-x) / speed * dx;
    if (time + duration > scene.duration_s) return a.speed - slope * dx * (n + (scene.duration_s - time) / duration);
    time += duration;
  }
  return too_near();
}

/// Overlap -h after the test's duration for a grain pressed on a wall by its weight, without inertia: h = h0 exp(-m g
/// t/C_n).
Result<double> settled_overlap(const Impact& scene, const FormulaArguments&) {
  const double weight = mass_kg(scene, scene.grains[0]) * scene.gravity_m_s2;
  const double gap = first_gap(scene) * std::exp(-weight * scene.duration_s / squeezing(scene));
  if (gap < least_gap(scene)) return too_near();
  return -gap;
}

constexpr Formula kViscous[] = {
    {"squeeze_force",
     [](auto& scene, auto& arguments) -> Result<double> {
       return -squeezing(scene) * pair_of(scene).speed / std::max(arguments.gap_m, least_gap(scene));
     },
     "6 pi mu R*^2 v/h at a gap, v the speed of parting"},
    {"squeezed_speed", squeezed_speed, "v - 6 pi mu R*^2/m* ln(h0/h), dh/dt = -v"},
    {"settled_overlap", settled_overlap, "-h0 exp(-m g t/(6 pi mu R^2)), without inertia", FormulaNeeds::wall},
    {"sheared_velocity",
     [](auto& scene, auto& arguments) -> Result<double> {
       return sheared(scene, arguments.grain).velocity.*arguments.axis;
     },
     "sliding at a gap: decays with 6 pi mu R* (8/15 ln(R*/h) + 0.9588)"},
    {"sheared_spin",
     [](auto& scene, auto& arguments) -> Result<double> {
       return sheared(scene, arguments.grain).spin.*arguments.axis;
     },
     "the same of a spin, with the lever r + h/2"},
};

}  // namespace

std::span<const Formula> viscous_formulas() {
  return kViscous;
}

}  // namespace pastefit
