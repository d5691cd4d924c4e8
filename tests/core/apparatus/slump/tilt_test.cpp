#include "core/apparatus/slump/tilt.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "core/apparatus/slump/packing.h"
#include "core/world/world.h"
#include "tests/core/apparatus/slump/bridges.h"

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
  test.contact.bridge = parabolic_bridge(c, 0.3 * r);
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

TEST_CASE("the angle is that of the table, and the lowest grains have moved down it by what counts as sliding") {
  const SlumpTest test = stiff_heap(60, 0.3);
  std::map<std::int32_t, Vec3> at_rest, at_last;
  double inclination = 0;
  RunOptions options;
  options.watch_interval_s = 0.01;
  options.watch = [&](const Snapshot& snapshot) {
    const Particles& grains = snapshot.world->particles;
    if (snapshot.phase == "step1.rest") at_rest.clear();
    for (std::int32_t i = 0; i < grains.count(); ++i) {
      const auto& grain = grains.motion[i];
      if (snapshot.phase == "step1.rest" && grain.position.z < 2 * grain.radius)
        at_rest[grains.identity[i]] = grain.position;
      if (snapshot.phase == "tilt") at_last[grains.identity[i]] = grain.position;
    }
    if (snapshot.phase == "tilt")
      if (const Plate* table = std::get_if<Plate>(&snapshot.world->walls[kTable].shape))
        inclination = std::atan2(table->along.z, table->along.x);
    return true;
  };
  const Outcome outcome = simulate(test, options);
  REQUIRE_FALSE(outcome.failure);
  CHECK(inclination / kDegree == Approx(*outcome.readings.find("tilt.slide_angle_deg")).epsilon(1e-6));
  REQUIRE(at_rest.size() > 10);
  double slid = 0;
  for (const auto& [grain, from] : at_rest) {
    const double edge = -0.5 * test.table_length_m;
    const Vec3& to = at_last.at(grain);
    slid += from.x - edge - (std::cos(inclination) * (to.x - edge) + std::sin(inclination) * to.z);
  }
  // Looks are sixteen steps apart, in which a sliding heap goes on by some tenths of a millimetre.
  CHECK(slid / static_cast<double>(at_rest.size()) == Approx(test.tilt->slide_m).margin(3e-4));
}

TEST_CASE("the energy of a tilt is accounted for") {
  const Outcome outcome = simulate(stiff_heap(60, 0.3));
  REQUIRE_FALSE(outcome.failure);
  CHECK(std::fabs(outcome.run.energy_error.value()) < 4e-3);  // as of the drops in sticking_test.cpp
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
