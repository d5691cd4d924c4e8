#include <catch2/catch.hpp>
#include <cmath>

#include "core/apparatus/drive.h"
#include "core/laws/normal.h"
#include "core/step/stepper.h"
#include "core/world/world.h"

namespace pastefit {
namespace {

constexpr double kLidGrain = 0.01;  // [m]

/// A layer of equal grains on a floor, under a lid some way above.
World layer_under_lid(int across) {
  ContactModel model;
  std::vector<Vec3> centres;
  for (int x = 0; x < across; ++x)
    for (int y = 0; y < across; ++y) centres.push_back({3 * kLidGrain * x, 3 * kLidGrain * y, kLidGrain});
  World world;
  world.particles = make_particles(centres, std::vector<double>(centres.size(), kLidGrain), 2500);
  set_contact_model(world, model, kLidGrain);
  Wall floor, lid;
  floor.shape = Plane{};
  lid.shape = Plane{{0, 0, 2.2 * kLidGrain}, {0, 0, -1}};
  floor.pair = lid.pair = wall_pair(model, {}, kLidGrain);
  world.walls = {floor, lid};
  return world;
}

TEST_CASE("a lid comes to rest with its load, as deep as the grains give way, if it has the mass of what it touches") {
  World world = layer_under_lid(4);
  const double mass = 16 * world.particles.mass(0);
  const Servo servo{-16 * 0.5, mass, 0.1};
  Stepper stepper(world, {});
  while (world.time < 0.6) {
    const auto problem = stepper.step([&](World& moved, double dt) { press(servo, {&moved.walls[1]}, dt); });
    INFO((problem ? problem->message : ""));
    REQUIRE_FALSE(problem);
  }
  const double weight = world.particles.mass(0) * kGravity, load = 0.5;
  CHECK(world.walls[1].force.z == Approx(16 * load).epsilon(1e-6));
  CHECK(world.walls[0].force.z == Approx(-16 * (load + weight)).epsilon(1e-6));
  const PairConstants& pair = world.walls[0].pair;
  const double sunk =
      Hertz::overlap_under(pair, kLidGrain, load) + Hertz::overlap_under(pair, kLidGrain, load + weight);
  const double height = std::get<Plane>(world.walls[1].shape).point.z;
  CHECK(2 * kLidGrain - height == Approx(sunk).epsilon(1e-5));
}

TEST_CASE("a lid that nothing resists comes to its fastest speed, in the time its dashpot gives it") {
  constexpr double dt = 1e-4;
  const Servo servo{-3, 0.2, 0.05};
  Wall plane, ribs;
  ribs.velocity.x = 0.7;
  const double rate = 3 / 0.05 / 0.2;  // c/m
  double time = 0;
  for (int n = 0; n < 40; ++n, time += dt) press(servo, {&plane, &ribs}, dt);
  // Taken at the end of the step: of first order, half a step's share of the rate.
  CHECK(plane.velocity.z == Approx(-0.05 * (1 - std::exp(-rate * time))).epsilon(0.5 * rate * dt));
  for (int n = 0; n < 10000; ++n) press(servo, {&plane, &ribs}, dt);
  CHECK(plane.velocity.z == Approx(-0.05).epsilon(1e-9));
  CHECK(ribs.velocity.z == plane.velocity.z);
  CHECK(ribs.velocity.x == 0.7);
}

}  // namespace
}  // namespace pastefit
