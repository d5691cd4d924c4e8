#include <catch2/catch.hpp>
#include <cmath>

#include "core/apparatus/impact/impact.h"
#include "core/world/world.h"

namespace pastefit {
namespace {

constexpr double kRadius = 0.01, kRestitution = 0.7;

/// A grain just above a plane of its own material, on its way down.
Impact falling(double speed_m_s) {
  Impact test;
  test.contact.youngs_modulus_pa = 1e8;
  test.contact.restitution = kRestitution;
  ImpactGrain grain;
  grain.radius_m = kRadius;
  grain.centre_m = {0, 0, 1.001 * kRadius};
  grain.velocity_m_s = {0, 0, -speed_m_s};
  test.grains = {grain};
  ImpactWall plane;
  plane.shape = Plane{};
  plane.surface.youngs_modulus_pa = test.contact.youngs_modulus_pa;
  plane.surface.restitution = kRestitution;
  test.walls = {plane};
  test.gravity_m_s2 = kGravity;
  test.duration_s = 10;
  test.rebound_gap_m = 0.01 * kRadius;
  return test;
}

double read(const Outcome& outcome, const char* name) {
  return outcome.readings.find(name).value();
}

TEST_CASE("a run that watches a rebound ends beyond the gap, on the way up") {
  const Outcome outcome = simulate(falling(2));
  REQUIRE_FALSE(outcome.failure);
  CHECK(read(outcome, "time_s") < 0.01);
  CHECK(read(outcome, "grain0.position_z_m") > 1.01 * kRadius);
  CHECK(read(outcome, "grain0.velocity_z_m_s") == Approx(2 * kRestitution).epsilon(0.01));
  CHECK(read(outcome, "rebound_top_m") == Approx(read(outcome, "grain0.position_z_m")));
}

TEST_CASE("a run that watches a rebound ends when the grain comes back from below the gap, and knows how far it went") {
  Impact test = falling(2);
  test.rebound_gap_m = 1;
  const double rise_m = std::pow(kRestitution * 2, 2) / (2 * kGravity);
  const Outcome outcome = simulate(test);
  REQUIRE_FALSE(outcome.failure);
  CHECK(read(outcome, "rebound_top_m") - kRadius == Approx(rise_m).epsilon(0.01));
  CHECK(read(outcome, "time_s") < 0.25);
}

TEST_CASE("a grain that touches nothing has no rebound, and the run lasts as long as it was given") {
  Impact test = falling(2);
  test.gravity_m_s2 = 0;
  test.grains[0].velocity_m_s.z = 2;
  test.duration_s = 0.01;
  const Outcome outcome = simulate(test);
  REQUIRE_FALSE(outcome.failure);
  CHECK(read(outcome, "time_s") == Approx(0.01));
  CHECK_FALSE(outcome.readings.find("rebound_top_m"));
}

}  // namespace
}  // namespace pastefit
