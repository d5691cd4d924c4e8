#include "core/apparatus/slump/tilt.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace pastefit;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A heap of coarse grains held together by bridges of so many weights of a grain, on a table of this friction.
SlumpTest stiff_heap(double strength_in_weights, double table_friction) {
  SlumpTest test;
  test.grains.radius_m = 0.012;
  test.lift_velocity_m_s = 0.2;
  const double r = test.grains.radius_m;
  const double c = strength_in_weights * test.bulk_density_kg_m3 / 0.6 * 4.19 * r * r * r * kGravity;
  test.contact.bridge = {BridgeShape::polynomial,
                         BridgeFormation::film,
                         c / (0.09 * r * r),
                         2 * c / (0.3 * r),
                         c,
                         -0.3 * r,
                         0.15 * r,
                         0,
                         0,
                         0};
  test.contact.friction = test.contact.rolling_friction = 0.5;
  test.table_wall.friction = table_friction;
  test.table_wall.rolling_friction = 0.5;
  test.tilt = Tilt{3, 0.002};
  return test;
}

double slide_angle(const SlumpTest& test) {
  const Outcome outcome = simulate(test);
  REQUIRE_FALSE(outcome.failure);
  return *outcome.readings.find("tilt.slide_angle_deg");
}

}  // namespace

TEST_CASE("a heap that holds together slides at the angle of the table's friction") {
  for (const double friction : {0.1, 0.2, 0.4}) {
    const SlumpTest test = stiff_heap(60, friction);
    // From rest at atan(friction), the heap moves by g w t^3/6 while the table turns on.
    const double delay_s = std::cbrt(6 * test.tilt->slide_m / (kGravity * kDegree * test.tilt->rate_deg_s));
    const double expected = std::atan(friction) / kDegree, late = delay_s * test.tilt->rate_deg_s;
    INFO("friction " << friction << ", " << expected << " degrees, late by up to " << late);
    const double found = slide_angle(test);
    CHECK(found > expected - 0.5);
    CHECK(found < expected + late + 0.5);
  }
}

TEST_CASE("a heap that sticks to the table slides later, and at the steepest angle not at all") {
  SlumpTest test = stiff_heap(60, 0.3);
  const double loose = slide_angle(test);
  test.table_wall.cohesion_factor = 0.3;
  const double sticky = slide_angle(test);
  CHECK(sticky > loose + 2);
  test.table_wall.cohesion_factor = 1;
  CHECK(slide_angle(test) > sticky);
}

TEST_CASE("a tilt changes nothing of step 1, and a tilt of a dropped heap is refused") {
  SlumpTest test = stiff_heap(20, 0.4);
  const Outcome tilted = simulate(test);
  test.tilt.reset();
  const Outcome level = simulate(test);
  CHECK(tilted.readings.find("step1.height_mm") == level.readings.find("step1.height_mm"));
  CHECK(tilted.readings.find("step1.spread_mm") == level.readings.find("step1.spread_mm"));
  CHECK_FALSE(level.readings.find("tilt.slide_angle_deg"));
  test.tilt.emplace();
  test.drop.emplace();
  const Faults faults = validate(test);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].where == "tilt");
}
