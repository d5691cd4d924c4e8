#include "core/step/time_step.h"

#include <algorithm>
#include <cmath>

#include "core/laws/lubrication.h"
#include "core/laws/table.h"

namespace pastefit {

namespace {

constexpr double kSlowest = 0.01;     // [m/s] lowest speed assumed
constexpr double kLeastLoss = 0.004;  // energy loss of a collision below which the number of steps no longer grows
constexpr double kFastCrossing = 10;  // over the speed that a bridge can cause
constexpr double kLevelsPerOctave = 16;
constexpr double kNarrowGaps = 8;         // neighbours of a grain in a packing at touch, or nearly so
constexpr double kLeastOverlap = 1e-3;    // over a radius, of grains with little attraction: from their weight
constexpr double kMostViscousSteps = 20;  // for one step without viscosity

/// The level at or below a step. The last bits of pow differ between processors; levels do not.
double level_below(double step) {
  int octave = 0;
  const double mantissa = std::frexp(step, &octave);
  return std::ldexp(std::floor(mantissa * 2 * kLevelsPerOctave) / (2 * kLevelsPerOctave), octave);
}

double stability_limit(const StabilityLimits& limits) {
  return limits.stiffest > 0 ? std::sqrt(2 / limits.stiffest) : 1e300;
}

double impact_limit(const World& world, const StabilityLimits& limits) {
  double loss = world.grain_pair.lost_share;
  for (const Wall& wall : world.walls) loss = std::min(loss, wall.pair.lost_share);
  const double mass = 0.5 * limits.smallest_mass, radius = 0.5 * limits.smallest_radius;
  const double speed = std::max(limits.fastest, kSlowest);
  const PairConstants& pair = world.grain_pair;
  const double shortest = with_law(NormalLaws{}, acting(world.normal, pair),
                                   [&](auto law) { return law.collision_time(pair, radius, mass, speed); });
  return std::cbrt(std::max(loss, kLeastLoss)) * shortest;
}

double bridge_limit(const World& world, const StabilityLimits& limits) {
  const PairConstants& pair = world.grain_pair;
  if (world.attraction == BridgeShape::none || pair.rupture_gap <= 0) return 1e300;
  const double scale = limits.smallest_radius / world.reference_radius;
  const double gap = pair.rupture_gap * scale;
  const double escape = std::sqrt(2 * pair.bridge_c * scale * scale * gap / (0.5 * limits.smallest_mass));
  return gap / std::clamp(limits.fastest, kSlowest, std::max(kSlowest, kFastCrossing * escape));
}

}  // namespace

double viscous_step(const PairConstants& pair, double radius, double mass) {
  if (pair.viscosity == 0) return 1e300;
  const double effective = 0.5 * radius, scale = pair.size_per_radius * effective;
  return mass / (kNarrowGaps * lubrication(pair, 0.0, effective, scale, 1.0, 0.0, 0.0, 0.0).damping);
}

double advised_step(const World& world, const StabilityLimits& limits, const StepOptions& options) {
  return std::min({options.safety * stability_limit(limits), impact_limit(world, limits) / options.impact_resolution,
                   bridge_limit(world, limits) / options.bridge_resolution,
                   viscous_step(world.grain_pair, limits.smallest_radius, limits.smallest_mass)});
}

double largest_viscosity(ContactModel model, double radius, double mass, const StepOptions& options) {
  model.bridge.viscosity_pa_s = 1;
  const PairConstants pair = grain_pair(model, radius);
  const double overlap = 2 * radius * resting_overlap(model, radius);
  const double stiffness = pair.normal_stiffness * std::sqrt(0.5 * radius * std::max(overlap, kLeastOverlap * radius)) *
                           std::max(1.0, kSurfaceLightness * pair.tangential_ratio);
  const double step = options.safety * stability_limit({.stiffest = kNarrowGaps * stiffness / mass});
  return kMostViscousSteps * viscous_step(pair, radius, mass) / step;
}

bool TimeStep::is_sound() const {
  return step_ >= 0 && lowest_ > 0 && lowest_before_ > 0 && first_ >= 0 && smallest_ > 0 && in_window_ >= 0 &&
         in_window_ < kWindow;
}

double TimeStep::next(double advised) {
  if (first_ == 0) first_ = advised;
  smallest_ = std::min(smallest_, advised);
  const double level = level_below(advised);
  lowest_ = std::min(lowest_, level);
  if (step_ == 0 || level < step_) step_ = level;
  if (++in_window_ < kWindow) return step_;
  step_ = std::max(step_, level_below(std::min({lowest_, lowest_before_, kRise * step_})));
  lowest_before_ = lowest_;
  lowest_ = 1e300;
  in_window_ = 0;
  return step_;
}

}  // namespace pastefit
