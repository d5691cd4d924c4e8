#include "core/step/lists.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/core/scene.h"

namespace pastefit {
namespace {

constexpr double kSize = 0.01;

/// A lattice of grains that do not touch, long enough for three blocks.
World lattice() {
  std::vector<Vec3> centres;
  for (int z = 0; z < 25; ++z)
    for (int y = 0; y < 14; ++y)
      for (int x = 0; x < 14; ++x) centres.push_back({3 * kSize * x, 3 * kSize * y, 3.2 * kSize * z});
  World world;
  world.reference_radius = kSize;
  world.particles = make_particles(centres, std::vector<double>(centres.size(), kSize), 2500);
  return world;
}

/// Where the grain of that identity is in the list.
std::int32_t place_of(const World& world, std::int32_t identity) {
  const auto& all = world.particles.identity;
  return static_cast<std::int32_t>(std::find(all.begin(), all.end(), identity) - all.begin());
}

bool is_listed(const Block& block, std::int32_t a, std::int32_t b) {
  for (std::int32_t k = 0; k < block.contacts.count; ++k)
    if (std::minmax(block.contacts.first(k), block.contacts.second(k)) == std::minmax(a, b)) return true;
  return false;
}

TEST_CASE("a pair that may still meet stays listed while it moves apart, whichever block is chosen for anew") {
  World world = lattice();
  // Two grains in the middle of the first layers, a tenth of a radius apart, that may each go as far.
  constexpr std::int32_t kOne = 3 * 196 + 7 * 14 + 6, kOther = kOne + 1;
  constexpr double kStep = 1e-4, kSteps = 18, kOwn = 0.1 * kSize;
  Particles& grains = world.particles;
  const double closer = 0.45 * kSize;
  grains.motion[kOne].position.x += closer;
  grains.motion[kOther].position.x -= closer;
  for (const std::int32_t i : {kOne, kOther}) set_velocity(grains, i, {kOwn / (kStep * kSteps), 0, 0}, {});
  ThreadPool pool(1);
  Lists lists(world, 0.8 * kSize, pool, kernels_of_this_processor());
  lists.update(kStep, 0, 0);
  REQUIRE(world.pairs.blocks.size() >= 2);
  const std::int32_t one = place_of(world, kOne), other = place_of(world, kOther);
  REQUIRE(one < world.pairs.blocks[0].grains_end);
  REQUIRE(is_listed(world.pairs.blocks[0], one, other));

  // Both go half of their way, apart from each other: farther than two such ways. One of the next block has left its
  // room.
  grains.motion[one].position.x -= 0.55 * kOwn;
  grains.motion[other].position.x += 0.55 * kOwn;
  const std::int32_t stray = world.pairs.blocks[1].grains + 1000;
  grains.motion[stray].position.z += 0.1 * kSize;
  lists.note_exceeded(1);
  lists.update(kStep, 0, 0);
  REQUIRE(place_of(world, kOne) == one);  // nothing was sorted anew
  CHECK(is_listed(world.pairs.blocks[0], one, other));
}

}  // namespace
}  // namespace pastefit
