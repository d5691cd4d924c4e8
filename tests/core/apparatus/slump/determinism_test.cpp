#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <thread>
#include <vector>

#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/random.h"
#include "core/step/kernels.h"
#include "core/step/stepper.h"
#include "core/world/world.h"

using namespace pastefit;

namespace {

SlumpTest sticky_test() {
  SlumpTest test;
  test.grains.radius_m = 0.014;
  test.lift_velocity_m_s = 0.3;
  test.contact.youngs_modulus_pa = 5e6;
  const double r = test.grains.radius_m, c = 2000 * r * r;
  test.contact.bridge = {
      BridgeShape::polynomial, BridgeFormation::film, 0, 0.8 * c / (0.8 * r), c, -0.8 * r, 0.2 * r, 0, 0, 0};
  return test;
}

/// FNV-1a over every grain's place, velocity and spin, by identity.
std::uint64_t hash_of(const Particles& grains) {
  std::vector<std::int32_t> place(grains.count());
  for (std::int32_t i = 0; i < grains.count(); ++i) place[grains.identity[i]] = i;
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::int32_t i : place) {
    const Vec3 state[3] = {grains.motion[i].position, grains.velocity[i].linear, grains.velocity[i].angular};
    unsigned char bytes[sizeof state];
    std::memcpy(bytes, state, sizeof state);
    for (const unsigned char b : bytes) hash = (hash ^ b) * 0x100000001b3u;
  }
  return hash;
}

/// The same grains, which stick where they touch instead.
SlumpTest jkr_test() {
  SlumpTest test = sticky_test();
  test.contact.bridge = {};
  test.contact.normal = NormalLaw::jkr;
  test.contact.surface_energy_j_m2 = 400 * test.grains.radius_m;
  return test;
}

/// At the last moment watched; 0 if the run failed.
std::uint64_t hash_of_run(const SlumpTest& test, RunOptions options = {}) {
  std::uint64_t hash = 0;
  options.watch = [&](const Snapshot& snapshot) {
    hash = hash_of(snapshot.world->particles);
    return true;
  };
  return simulate(test, options).failure ? 0 : hash;
}

/// A heap of sticky grains, large enough for several blocks, that falls onto a floor and against two walls; 0 if it
/// failed.
std::uint64_t hash_of_large_heap(const SlumpTest& material, int threads) {
  const double radius = material.grains.radius_m;
  const RandomStream jitter(1, "large-heap");
  std::vector<Vec3> centres;
  for (std::uint64_t n = 0; n < 9000; ++n) {
    const auto x = static_cast<double>(n % 50), y = static_cast<double>(n / 50 % 15), z = static_cast<double>(n / 750);
    centres.push_back({(2.1 * x + jitter.uniform(2 * n, 0, 0.1)) * radius, 2.1 * y * radius,
                       (1 + 2.1 * z + jitter.uniform(2 * n + 1, 0, 0.1)) * radius});
  }
  World world;
  world.particles = make_particles(centres, std::vector<double>(centres.size(), radius), 2500);
  set_contact_model(world, material.contact, radius);
  world.walls.resize(3);
  for (Wall& wall : world.walls) wall.pair = wall_pair(material.contact, material.table_wall, radius);
  world.walls[0].shape = Plane{};
  world.walls[1].shape = Plane{{-radius, 0, 0}, {1, 0, 0}};
  world.walls[2].shape = Plane{{0, -radius, 0}, {0, 1, 0}};
  world.walls[2].velocity = {0, 0.1, 0};
  StepOptions options;
  options.threads = threads;
  Stepper stepper(world, options);
  for (int n = 0; n < 300; ++n)
    if (stepper.step({})) return 0;
  return world.pairs.blocks.size() < 4 ? 0 : hash_of(world.particles);
}

}  // namespace

TEST_CASE("1, 2, 3 and 8 threads running side by side give the same bits") {
  const std::uint64_t alone = hash_of_run(sticky_test());
  REQUIRE(alone != 0);
  for (const int threads : {2, 3, 8}) {
    std::vector<std::uint64_t> hashes(threads);
    std::vector<std::thread> workers;
    for (int t = 0; t < threads; ++t) workers.emplace_back([&, t] { hashes[t] = hash_of_run(sticky_test()); });
    for (std::thread& worker : workers) worker.join();
    CHECK(std::all_of(hashes.begin(), hashes.end(), [&](std::uint64_t h) { return h == alone; }));
  }
}

TEST_CASE("1, 2 and 3 threads inside one simulation give the same bits") {
  for (const SlumpTest& material : {sticky_test(), jkr_test()}) {
    const std::uint64_t alone = hash_of_large_heap(material, 1);
    REQUIRE(alone != 0);
    CHECK(hash_of_large_heap(material, 2) == alone);
    CHECK(hash_of_large_heap(material, 3) == alone);
  }
}

TEST_CASE("a slump of grains that stick gives the same bits on 1, 2 and 3 threads") {
  RunOptions options;
  options.steps.threads = 1;
  const std::uint64_t alone = hash_of_run(jkr_test(), options);
  REQUIRE(alone != 0);
  for (const int threads : {2, 3}) {
    options.steps.threads = threads;
    CHECK(hash_of_run(jkr_test(), options) == alone);
  }
}

TEST_CASE("without the energy balance a run has the same bits, and says that it kept none") {
  SlumpTest test = sticky_test();
  test.drop = DropPlate{};
  RunOptions without;
  without.steps.energy_balance = false;
  const std::uint64_t kept = hash_of_run(test);
  REQUIRE(kept != 0);
  CHECK(hash_of_run(test, without) == kept);
  CHECK(simulate(test).run.energy_error.has_value());
  CHECK_FALSE(simulate(test, without).run.energy_error.has_value());
}

// The number is the contract of core/README.md: it changes when the physics or the order of any sum changes, and then
// every stored evaluation is void and the shipped cards are to be checked. Change it knowingly, and say why in the
// commit.
TEST_CASE("a slump's bits are those on record") {
  if (kernels_of_this_processor().instruction_set == four_lanes::kernels.instruction_set) return;
  CHECK(hash_of_run(sticky_test()) == 0x1d5a394266708ef7u);
}

TEST_CASE("in four lanes a slump has the bits on record, whatever the type of processor") {
  RunOptions options;
  options.steps.kernels = &four_lanes::kernels;
  CHECK(hash_of_run(sticky_test(), options) == 0x11d3d6d8df91cecdu);
}
