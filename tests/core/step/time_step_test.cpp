#include "core/step/time_step.h"

#include <catch2/catch.hpp>

#include "tests/core/scene.h"

using namespace pastefit;

namespace {

World sticky_world(double rupture_gap) {
  ContactModel model;
  model.youngs_modulus_pa = 5e6;
  model.bridge = {BridgeShape::linear, BridgeFormation::film, 0, 0, 0.1, -rupture_gap, rupture_gap, 0, 0, 0};
  World world;
  set_contact_model(world, model, 0.01);
  world.particles = make_particles({{0, 0, 0}, {0.05, 0, 0}}, {0.01, 0.01}, 2500);
  return world;
}

double advice(const World& world, double fastest) {
  return advised_step(world, {0.01, world.particles.mass(0), fastest}, {});
}

}  // namespace

TEST_CASE("a step stays as it is while the advice rises and falls within a collision") {
  TimeStep step;
  const double first = step.next(1e-4);
  CHECK(first <= 1e-4);
  CHECK(first > 0.93e-4);
  for (int n = 1; n < 60; ++n) CHECK(step.next(1e-4 * (1 + std::sin(n * 0.05))) == first);
}

TEST_CASE("a step falls at once and rises only after two windows, a fifth at a time") {
  TimeStep step;
  const double high = step.next(1e-4), low = step.next(2e-5);
  CHECK(low <= 2e-5);
  int waited = 0;
  while (step.next(1e-4) == low) ++waited;
  CHECK(waited > 64);
  CHECK(waited < 200);
  CHECK(step.next(1e-4) <= 1.2 * low);
  for (int n = 0; n < 64 * 20; ++n) step.next(1e-4);
  CHECK(step.next(1e-4) == high);
}

TEST_CASE("a grain far faster than a bridge can make it does not shorten the step for the bridge") {
  const World narrow = sticky_world(1e-5), none = [] {
    World world = sticky_world(1e-5);
    world.attraction = BridgeShape::none;
    return world;
  }();
  CHECK(advice(narrow, 0.02) < 0.5 * advice(none, 0.02));
  const double escape = std::sqrt(2 * 0.1 * 1e-5 / (0.5 * narrow.particles.mass(0)));
  CHECK(advice(narrow, 20 * escape) == Approx(1e-5 / (10 * 10 * escape)));
}

TEST_CASE("the more energy a collision keeps, the more steps it takes") {
  const auto limit = [](double restitution) {
    World world = sticky_world(0.001);
    world.attraction = BridgeShape::none;
    ContactModel model;
    model.youngs_modulus_pa = 5e6;
    model.restitution = restitution;
    world.grain_pair = grain_pair(model, 0.01);
    return advice(world, 1);
  };
  // Steps go with the third root of the energy that is lost, because the error of a collision does with their cube.
  CHECK(limit(0.5) == Approx(std::cbrt(0.75) * limit(0.01)).epsilon(0.001));
  CHECK(limit(0.99) == Approx(std::cbrt(0.0199) * limit(0.01)).epsilon(0.001));
  CHECK(limit(1.0) == limit(0.999));
}
