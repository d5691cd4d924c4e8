#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <thread>
#include <vector>

#include "core/rigs/packing.h"
#include "core/simulate.h"
#include "core/step/kernels.h"
#include "core/world/world.h"

using namespace pastefit;

namespace {

SlumpTable sticky_test() {
  SlumpTable test;
  test.grains.radius_m = 0.014;
  test.lift_velocity_m_s = 0.3;
  test.contact.youngs_modulus_pa = 5e6;
  const double r = test.grains.radius_m, c = 2000 * r * r;
  test.contact.bridge = {
      BridgeShape::polynomial, BridgeFormation::film, 0, 0.8 * c / (0.8 * r), c, -0.8 * r, 0.2 * r, 0, 0, 0};
  return test;
}

/// FNV-1a over every grain's place, velocity and spin, by identity, at the last moment watched; 0 if the run failed.
std::uint64_t hash_of_run(const SlumpTable& test) {
  std::uint64_t hash = 0;
  RunOptions options;
  options.watch = [&](const Moment& moment) {
    const Particles& grains = moment.world->particles;
    std::vector<std::int32_t> place(grains.count());
    for (std::int32_t i = 0; i < grains.count(); ++i) place[grains.identity[i]] = i;
    hash = 0xcbf29ce484222325u;
    for (const std::int32_t i : place) {
      const Vec3 state[3] = {grains.motion[i].position, grains.motion[i].velocity, grains.spin[i].velocity};
      unsigned char bytes[sizeof state];
      std::memcpy(bytes, state, sizeof state);
      for (const unsigned char b : bytes) hash = (hash ^ b) * 0x100000001b3u;
    }
    return true;
  };
  return simulate(test, options).failure ? 0 : hash;
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

// The number is the contract of core/README.md: it changes when the physics or the order of any sum changes, and then
// every stored evaluation is void and the shipped cards are to be checked. Change it knowingly, and say why in the
// commit.
TEST_CASE("a slump's bits are those on record") {
  if (kernels_of_this_processor().instruction_set == sse2::kernels.instruction_set) return;
  CHECK(hash_of_run(sticky_test()) == 0x32dfa9847610de45u);
}
