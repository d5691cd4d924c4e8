#include "core/step/runner.h"

#include <catch2/catch.hpp>

#include "core/laws/normal.h"
#include "core/world/world.h"

using namespace pastefit;

namespace {

constexpr double kGrainRadius = 0.01;
constexpr std::size_t kGround = 0;

/// One grain a little above a floor.
World grain_above_floor() {
  ContactModel model;
  World world;
  world.particles = make_particles({{0, 0, 1.1 * kGrainRadius}}, {kGrainRadius}, 2500);
  set_contact_model(world, model, kGrainRadius);
  Wall floor;
  floor.shape = Plane{};
  floor.pair = wall_pair(model, {}, kGrainRadius);
  world.walls.push_back(floor);
  return world;
}

double lowest_point(const World& world) {
  return world.particles.motion[0].position.z - kGrainRadius;
}

std::vector<double> height_of_grain(const Particles& particles) {
  return {particles.motion[0].position.z};
}

}  // namespace

TEST_CASE("a phase that waits for rest moves walls at the same time", "[runner]") {
  constexpr double rise = 0.002, duration = 0.3;
  World world = grain_above_floor();
  RunOptions options;
  options.steps.impact_resolution = 100;  // one collision is all there is: its energy is no mean over many
  Runner runner(world, options, height_of_grain);
  const auto raise = [&](World& moved, double dt) {
    const bool rising = moved.time + dt < duration;
    moved.walls[kGround].velocity = {0, 0, rising ? rise / duration : 0.0};
  };
  const std::optional<Failure> problem = runner.settle({"raise", raise}, 4);
  INFO((problem ? problem->message : ""));
  REQUIRE_FALSE(problem);
  CHECK(runner.summary().settled);
  CHECK(world.time > duration);  // a grain that is carried up is not at rest
  const double weight = world.particles.mass(0) * world.gravity;
  const double sunk = Hertz::overlap_under(world.walls[kGround].pair, kGrainRadius, weight);
  const double one_step = runner.summary().time_step_s * rise / duration;
  const double still = options.rest.change_over_radius * kGrainRadius;
  CHECK(lowest_point(world) == Approx(rise - sunk).margin(one_step + still));
}

TEST_CASE("what counts as rest is the apparatus's word", "[runner]") {
  RunOptions options;
  World world = grain_above_floor();
  Runner of_height(world, options, height_of_grain);
  REQUIRE_FALSE(of_height.settle({"rest"}, 2));
  CHECK(of_height.summary().settled);
  CHECK(world.time < 1);

  // An apparatus that sees something in the same grain that never stays where it is.
  World same = grain_above_floor();
  double creep = 0;
  Runner of_creep(same, options, [&](const Particles&) { return std::vector{creep += 0.05 * kGrainRadius}; });
  REQUIRE_FALSE(of_creep.settle({"rest"}, 2));
  CHECK_FALSE(of_creep.summary().settled);
  CHECK(same.time >= 2);

  // One that changes so fast that readings mean nothing.
  World again = grain_above_floor();
  Runner of_flow(again, options, [&](const Particles&) { return std::vector{creep += 0.5 * kGrainRadius}; });
  const std::optional<Failure> problem = of_flow.settle({"rest"}, 0.5);
  REQUIRE(problem);
  CHECK(problem->reason == FailureReason::never_settled);
  CHECK(problem->phase == "rest");
}
