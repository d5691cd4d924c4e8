#include "core/apparatus/slump/slump_world.h"

namespace pastefit {

namespace {

constexpr double kGroundDepth = 0.1;  // [m] below the table

}  // namespace

Shape table_on_seat(const SlumpTest& test) {
  // A shell without height from the edge to the axis.
  if (test.drop && test.drop->motion == TableMotion::vertical) return Shell{{}, 0.5 * test.drop->length_m, 0, 0};
  Plate plate;
  plate.half_length = plate.half_width = 0.5 * (test.drop ? test.drop->length_m : test.table_length_m);
  return plate;
}

World world_in_mould(const SlumpTest& test, const Packing& packing) {
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
  add("table", table_on_seat(test), test.table_wall);
  add("ground", Plane{{0, 0, -kGroundDepth}}, test.table_wall);
  world.walls[kGround].pair.rolling_friction = 1;
  add("mould", Shell{{}, mould.base_radius_m, mould.top_radius_m, mould.height_m}, test.mould_wall);
  return world;
}

}  // namespace pastefit
