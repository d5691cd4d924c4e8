#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/rigs/packing.h"
#include "core/step/runner.h"

namespace pastefit {

namespace {

constexpr double kCap = 0.6;    // [s] for the column to come to rest
constexpr double kLook = 0.02;  // [s] between two changes of size
// [1/s]. The grains feel their cohesion all at once; without drag the column would swing like a jelly for seconds.
constexpr double kDrag = 40;
constexpr double kMostGrowth = 2e-3;  // in one look
constexpr double kShare = 0.35;       // of the growth that would bring the lid's pressure to what it should be at once
constexpr double kEven = 2e-4;        // growth below which the column fits

World world_under_lid(const SlumpTable& test, const Packing& packing) {
  World world;
  world.particles = make_particles(packing.centres, packing.radii, grain_density(test, packing));
  set_contact_model(world, test.contact, test.grains.radius_m);
  const auto add = [&](const char* name, Shape shape, const WallContact& surface) {
    Wall wall;
    wall.name = name;
    wall.shape = shape;
    wall.pair = wall_pair(test.contact, surface, test.grains.radius_m);
    world.walls.push_back(wall);
  };
  const Mould& mould = test.mould;
  WallContact smooth = test.mould_wall;
  smooth.friction = smooth.rolling_friction = smooth.cohesion_factor = 0;
  add("table", Plane{}, test.table_wall);
  add("mould", Shell{{}, mould.base_radius_m, mould.top_radius_m, mould.height_m}, test.mould_wall);
  add("lid", Plane{{0, 0, mould.height_m}, {0, 0, -1}}, smooth);
  world.drag = kDrag;
  return world;
}

/// Bulk modulus of touching grains whose overlap is `strain` of their diameter [Pa]: mean-field estimate
/// K = phi Z k/(12 pi R) with S_n = k and six neighbours.
double bulk_modulus(const World& world, double solid_fraction, double strain) {
  constexpr double kNeighbours = 6;
  const double radius = world.reference_radius;
  const double stiffness = world.grain_pair.normal_stiffness * std::sqrt(0.5 * radius * 2 * radius * strain);
  return solid_fraction * kNeighbours * stiffness / (12 * std::numbers::pi * radius);
}

void enlarge(Particles& grains, double k) {
  for (std::int32_t i = 0; i < grains.count(); ++i) {
    grains.motion[i].position = k * grains.motion[i].position;
    grains.motion[i].radius *= k;
  }
}

}  // namespace

Packing full_mould(const SlumpTable& test, const Packing& packing, const RunOptions& asked) {
  RunOptions options = asked;
  options.steps.ledger = options.steps.sleep = false;  // the column is worked on from outside
  options.steps.fixed_step_s.reset();                  // meant for the test
  World world = world_under_lid(test, packing);
  Runner runner(world, options);
  Packing full = packing;

  const double weight_of_a_layer = test.bulk_density_kg_m3 * kGravity * test.grains.radius_m;  // per area
  const double lid_area = std::numbers::pi * test.mould.top_radius_m * test.mould.top_radius_m;
  // Where nothing attracts, the weight of a column of sand still presses soft grains together by a percent or two.
  constexpr double kLeastStrain = 0.015;
  const double modulus = bulk_modulus(world, packing.solid_volume_m3 / volume_m3(test.mould),
                                      std::max(squeeze(test.contact, test.grains.radius_m), kLeastStrain));
  double size = 1;
  int even = 0;  // looks in a row
  for (double waited = 0; waited < kCap && even < 2; waited += kLook) {
    double force = 0;
    int steps = 0;
    full.failure = runner.run("fill.settle", kLook, [&](World& now, double) {
      force += now.walls.back().force.z;
      ++steps;
    });
    if (full.failure) break;
    const double missing = weight_of_a_layer - force / steps / lid_area;
    const double growth = std::clamp(kShare * missing / (3 * modulus), -kMostGrowth, kMostGrowth);
    even = std::fabs(growth) < kEven ? even + 1 : 0;
    enlarge(world.particles, 1 + growth);
    runner.changed();
    size *= 1 + growth;
  }
  full.solid_volume_m3 *= size * size * size;
  for (std::int32_t i = 0; i < world.particles.count(); ++i) {
    full.centres[i] = world.particles.motion[i].position;
    full.radii[i] = world.particles.motion[i].radius;
  }
  full.run = runner.summary();
  return full;
}

}  // namespace pastefit
