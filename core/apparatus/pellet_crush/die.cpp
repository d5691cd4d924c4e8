#include "core/apparatus/pellet_crush/die.h"

#include <algorithm>

#include "core/observe/heap.h"

namespace pastefit {

namespace {

constexpr double kEmptiest = 0.25;  // solid share of a die that is full

World empty_die(const PelletCrush& test, const LooseGrains& grains) {
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

}  // namespace

double poured_grains(const PelletCrush& test) {
  return number_of_granules(test, poured_volume_m3(filled_volume_m3(test)));
}

FilledVessel fill_die(const PelletCrush& test, const RunOptions& options) {
  const double radius = 0.5 * test.die_diameter_m;
  FilledVessel filled = fill_vessel(
      test, {test.fill_height_m, test.pour_speed_m_s},
      pour(test.grains, test.packing_seed, poured_volume_m3(filled_volume_m3(test)), radius,
           [&](double) { return radius; }),
      [&](const LooseGrains& grains) { return empty_die(test, grains); }, rest_measure_of_heap, options);
  const double fraction = filled.grains.solid_volume_m3 / filled_volume_m3(test);
  if (!filled.failure && fraction < kEmptiest) filled.failure = bridged(filled, fraction, kEmptiest);
  return filled;
}

}  // namespace pastefit
