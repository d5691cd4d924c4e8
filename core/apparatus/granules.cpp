#include "core/apparatus/granules.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/laws/constants.h"

namespace pastefit {

namespace {

constexpr double kMostSolid = 0.7;  // solid volume poured, over the volume of the vessel
constexpr double kDeepest = 0.9;    // overlap over the smaller radius
constexpr double kFillCap = 2;      // [s]
constexpr double kScrape = 0.5;     // [radii] centres less than this below the fill height are scraped away

void take_grains(const World& world, LooseGrains& grains) {
  grains = {};
  for (std::int32_t i = 0; i < world.particles.count(); ++i) {
    grains.centres.push_back(world.particles.motion[i].position);
    grains.radii.push_back(world.particles.motion[i].radius);
    grains.solid_volume_m3 += sphere_volume_m3(grains.radii.back());
  }
}

double height_energy(const World& world) {
  double sum = 0;
  for (std::int32_t i = 0; i < world.particles.count(); ++i)
    sum += world.particles.mass(i) * world.gravity * world.particles.motion[i].position.z;
  return sum;
}

LooseGrains struck_off(const LooseGrains& grains, double height) {
  LooseGrains kept;
  for (std::size_t i = 0; i < grains.centres.size(); ++i) {
    if (grains.centres[i].z > height - kScrape * grains.radii[i]) continue;
    kept.centres.push_back(grains.centres[i]);
    kept.radii.push_back(grains.radii[i]);
  }
  return kept;
}

}  // namespace

FilledVessel fill_vessel(const Specimen& granules, const Pouring& pouring, const LooseGrains& loose,
                         const Vessel& vessel, const RestMeasure& rest_measure, const RunOptions& asked) {
  RunOptions options = with_bounds_of(granules, asked);
  // A fixed step and the energy balance apply to the test, not to the filling.
  options.steps.fixed_step_s.reset();
  options.steps.energy_balance = false;
  FilledVessel filled;
  const auto settle = [&](World world, std::string_view phase, double moved_s) {
    Runner runner(world, options, rest_measure);
    filled.fall.start_height += height_energy(world);
    filled.failure = runner.settle({phase}, kFillCap, moved_s);
    filled.fall.start = filled.fall.height += height_energy(world);
    add_work(filled.run, runner.summary());
    take_grains(world, filled.grains);
  };
  World sinking = vessel(loose);
  sinking.drag = kGravity / pouring.pour_speed_m_s;
  settle(std::move(sinking), "fill.pour", top_of(loose) / pouring.pour_speed_m_s);
  if (!filled.failure) settle(vessel(struck_off(filled.grains, pouring.height_m)), "fill.strike", 0);
  return filled;
}

Failure bridged(const FilledVessel& filled, double solid_fraction, double emptiest) {
  return {FailureReason::packing_failed,
          "fill.strike",
          filled.run.steps,
          filled.run.simulated_s,
          -1,
          solid_fraction,
          emptiest,
          "the granules bridge and leave what they are poured into partly empty; take smaller ones, less surface "
          "energy, or pour them faster"};
}

RunOptions with_bounds_of(const Specimen& granules, RunOptions options) {
  options.rest.window_s *= std::sqrt(granules.grains.radius_m / GrainSizes{}.radius_m);
  options.rest.speed_over_fall *= 3;
  options.rest.change_over_radius *= 5;
  options.steps.overlap_limit = std::max(options.steps.overlap_limit, kDeepest);
  return options;
}

double poured_volume_m3(double vessel_m3) {
  return kMostSolid * vessel_m3;
}

double number_of_granules(const Specimen& granules, double solid_m3) {
  constexpr int kDraws = 1000;
  double volume = 0;
  for (int n = 0; n < kDraws; ++n) {
    const double radius = draw_radius(granules.grains, granules.packing_seed, static_cast<std::uint64_t>(n));
    volume += sphere_volume_m3(radius) / kDraws;
  }
  return solid_m3 / volume;
}

double sound_speed_m_s(const Specimen& granules) {
  constexpr double kOverlap = 0.01;  // of the diameter
  const double radius = granules.grains.radius_m;
  const double stiffness =
      grain_pair(granules.contact, radius).normal_stiffness * std::sqrt(0.5 * radius * kOverlap * 2 * radius);
  const double mass = granules.bulk_density_kg_m3 * 4 / 3 * std::numbers::pi * std::pow(radius, 3);
  return 2 * radius * std::sqrt(stiffness / mass);
}

void check_speed(FieldChecker& check, const Specimen& granules, const char* where, const char* tool, double speed,
                 const char* remedy) {
  constexpr double kQuasiStatic = 0.1;  // of the speed of sound
  if (!(granules.grains.radius_m > 0 && granules.contact.youngs_modulus_pa > 0 && granules.bulk_density_kg_m3 > 0))
    return;
  const double sound = sound_speed_m_s(granules);
  check.require(!(speed > kQuasiStatic * sound), where,
                std::string(tool) + " moves at " + FieldChecker::text(speed) +
                    " m/s, but sound in a bed of these granules at " + FieldChecker::text(sound) + " m/s only",
                std::string(remedy) + ": at most " + FieldChecker::text(kQuasiStatic * sound) +
                    " m/s, a tenth of it; or give stiffer granules");
}

void add_work(RunSummary& sum, const RunSummary& part) {
  sum.particles = part.particles;
  sum.steps += part.steps;
  sum.particle_steps += part.particle_steps;
  sum.simulated_s += part.simulated_s;
}

}  // namespace pastefit
