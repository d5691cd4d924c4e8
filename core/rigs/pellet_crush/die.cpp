#include "core/rigs/pellet_crush/die.h"

#include <algorithm>
#include <cmath>

#include "core/observe/heap.h"
#include "core/step/runner.h"

namespace pastefit {

namespace {

constexpr double kMostSolid = 0.7;  // share of the die that is poured as solid; what does not fit is scraped away
constexpr double kEmptiest = 0.25;  // solid share of a die that is full
constexpr double kDeepest = 0.9;    // overlap over the smaller radius
constexpr double kFillCap = 2;      // [s]
constexpr double kScrape = 0.5;     // [radii] centres less than this below the fill height are scraped away

World filling_world(const PelletCrush& test, const LooseGrains& grains) {
  World world;
  world.particles = make_particles(grains.centres, grains.radii, test.bulk_density_kg_m3);
  set_contact_model(world, test.contact, test.grains.radius_m);
  const PairConstants surface = wall_pair(test.contact, test.tools, test.grains.radius_m);
  const double radius = 0.5 * test.die_diameter_m, top = std::max(top_of(grains), test.fill_height_m);
  Wall floor, die;
  floor.name = "floor";
  floor.shape = Plane{};
  floor.pair = surface;
  die.name = "die";
  die.shape = Shell{{}, radius, radius, top + 2 * test.grains.radius_m};
  die.pair = surface;
  world.walls = {floor, die};
  return world;
}

void take_grains(const World& world, LooseGrains& grains) {
  grains = {};
  for (std::int32_t i = 0; i < world.particles.count(); ++i) {
    grains.centres.push_back(world.particles.motion[i].position);
    grains.radii.push_back(world.particles.motion[i].radius);
    grains.solid_volume_m3 += sphere_volume_m3(grains.radii.back());
  }
}

void add_work(RunSummary& sum, const RunSummary& part) {
  sum.particles = part.particles;
  sum.steps += part.steps;
  sum.particle_steps += part.particle_steps;
  sum.simulated_s += part.simulated_s;
}

void let_sink(const PelletCrush& test, const RunOptions& options, FilledDie& filled) {
  World world = filling_world(test, filled.grains);
  world.drag = kGravity / test.pour_speed_m_s;
  Runner runner(world, options, posture_of_heap);
  filled.failure = runner.settle({"fill.pour"}, kFillCap, top_of(filled.grains) / test.pour_speed_m_s);
  add_work(filled.run, runner.summary());
  take_grains(world, filled.grains);
}

/// The rest closes up where its neighbours are gone.
void strike_off(const PelletCrush& test, const RunOptions& options, FilledDie& filled) {
  LooseGrains kept;
  for (std::size_t i = 0; i < filled.grains.centres.size(); ++i) {
    if (filled.grains.centres[i].z > test.fill_height_m - kScrape * filled.grains.radii[i]) continue;
    kept.centres.push_back(filled.grains.centres[i]);
    kept.radii.push_back(filled.grains.radii[i]);
  }
  World world = filling_world(test, kept);
  Runner runner(world, options, posture_of_heap);
  filled.failure = runner.settle({"fill.strike"}, kFillCap);
  add_work(filled.run, runner.summary());
  take_grains(world, filled.grains);
}

}  // namespace

RunOptions with_bounds_of(const PelletCrush& test, RunOptions options) {
  options.rest.window_s *= std::sqrt(test.grains.radius_m / GrainSizes{}.radius_m);
  options.rest.speed_over_fall *= 3;
  options.rest.change_over_radius *= 5;
  options.steps.overlap_limit = std::max(options.steps.overlap_limit, kDeepest);
  return options;
}

double poured_grains(const PelletCrush& test) {
  constexpr int kDraws = 1000;
  double volume = 0;
  for (int n = 0; n < kDraws; ++n)
    volume += sphere_volume_m3(draw_radius(test.grains, test.packing_seed, static_cast<std::uint64_t>(n))) / kDraws;
  return kMostSolid * filled_volume_m3(test) / volume;
}

FilledDie fill_die(const PelletCrush& test, const RunOptions& asked) {
  RunOptions options = with_bounds_of(test, asked);
  // A fixed step, sleep and the ledger are meant for the test.
  options.steps.fixed_step_s.reset();
  options.steps.sleep = options.steps.ledger = false;
  FilledDie filled;
  const double radius = 0.5 * test.die_diameter_m;
  filled.grains =
      pour(test.grains, test.packing_seed, kMostSolid * filled_volume_m3(test), radius, [&](double) { return radius; });
  let_sink(test, options, filled);
  if (!filled.failure) strike_off(test, options, filled);
  const double fraction = filled.grains.solid_volume_m3 / filled_volume_m3(test);
  if (!filled.failure && fraction < kEmptiest)
    filled.failure =
        Failure{FailureReason::packing_failed,
                "fill.strike",
                filled.run.steps,
                filled.run.simulated_s,
                -1,
                fraction,
                kEmptiest,
                "the granules bridge in the die and leave it partly empty; take smaller ones, less surface "
                "energy, or pour them faster"};
  return filled;
}

}  // namespace pastefit
