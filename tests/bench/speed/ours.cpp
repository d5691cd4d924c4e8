#include "tests/bench/speed/ours.h"

#include <ctime>
#include <stdexcept>
#include <utility>

#include "calibrate/base/machine.h"
#include "core/step/stepper.h"

namespace pastefit {

namespace {

Wall wall_of(Shape shape, bool cohesive) {
  Wall wall;
  wall.shape = shape;
  wall.pair = wall_pair(scene_material(cohesive), scene_wall(), kSceneRadius);
  return wall;
}

void take_steps(Stepper& stepper, int steps) {
  for (int n = 0; n < steps; ++n)
    if (const auto problem = stepper.step({})) throw std::runtime_error("our run failed: " + problem->message);
}

}  // namespace

World world_of(const Scene& scene, Bed&& given) {
  const Bed bed = std::move(given);
  World world;
  world.particles = make_particles(bed.centres, std::vector<double>(bed.centres.size(), kSceneRadius), kGrainDensity);
  set_contact_model(world, scene_material(scene.cohesive), kSceneRadius);
  world.walls.push_back(wall_of(Plane{}, scene.cohesive));
  if (scene.container == Container::mould) {
    const Mould mould = scene_mould();
    world.walls.push_back(wall_of(Shell{{}, mould.base_radius_m, mould.top_radius_m, mould.height_m}, scene.cohesive));
    return world;
  }
  const Vec3 far_corner{bed.length_m, bed.width_m, 0};
  for (const Plane& side :
       {Plane{{}, {1, 0, 0}}, Plane{far_corner, {-1, 0, 0}}, Plane{{}, {0, 1, 0}}, Plane{far_corner, {0, -1, 0}}})
    world.walls.push_back(wall_of(side, scene.cohesive));
  return world;
}

OurRun run_ours(const Scene& scene, Bed&& bed, bool energy_balance, const KernelTable& kernels) {
  World world = world_of(scene, std::move(bed));
  StepOptions options;
  options.fixed_step_s = kSceneStep;
  options.energy_balance = energy_balance;
  options.kernels = &kernels;
  OurRun run;
  options.clock = &run.stages;
  Stepper stepper(world, options);
  take_steps(stepper, scene.warm_steps);
  if (scene.container == Container::mould) world.walls[1].velocity = {0, 0, kLiftSpeed};
  run.stages = {};
  const double start = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
  take_steps(stepper, scene.steps);
  run.seconds = processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - start;
  run.grains = world.particles.count();
  run.advised_step_s = stepper.smallest_advised_step();
  for (const Block& block : world.pairs.blocks) {
    run.contacts += static_cast<double>(block.contacts.count) / world.particles.count();
    run.bridges += static_cast<double>(block.bridges.count) / world.particles.count();
  }
  return run;
}

}  // namespace pastefit
