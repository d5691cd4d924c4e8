#include "core/apparatus/slump/spread_series.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/world/world.h"

using namespace pastefit;

namespace {

/// A ring of grains with this width, at a time.
World ring(double width_m, double time_s) {
  constexpr double radius = 0.005;
  std::vector<Vec3> centres;
  const double middle = 0.5 * width_m - radius;
  const int count = 24 * static_cast<int>(std::ceil(middle / radius / 7.6));
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * 3.14159265358979 * k / count;
    centres.push_back({middle * std::cos(angle), middle * std::sin(angle), radius});
  }
  World world;
  world.particles = make_particles(centres, std::vector<double>(centres.size(), radius), 2000);
  world.time = time_s;
  return world;
}

/// A spread that grows from 0.2 m to 0.6 m by 0.1 m/s, and stays; the lift began at 3 s.
SpreadSeries growing() {
  SpreadSeries series;
  for (double t = 0; t <= 6; t += 0.002) series.take(ring(std::min(0.2 + 0.1 * t, 0.6), 3 + t), 0.005);
  return series;
}

}  // namespace

TEST_CASE("the times of a flow are those at which the spread was so wide, from the beginning of the lift") {
  const SpreadSeries series = growing();
  CHECK(series.time_to(0.5).value() == Approx(3).margin(0.02));
  CHECK(series.time_to(0.2).value() == Approx(0).margin(0.02));
  CHECK_FALSE(series.time_to(0.61));
  CHECK(series.time_of_flow() == Approx(3.94).margin(0.03));  // 0.99 of 0.6 m
}

TEST_CASE("a spread is taken every 10 ms, however small the steps are") {
  CHECK(growing().curve().points.size() == Approx(601).margin(2));
}

TEST_CASE("the residual of a measured curve is its root mean square distance, beyond the end from the last spread") {
  const SpreadSeries series = growing();
  CHECK(series.rms_difference({{0, 0.2}, {1, 0.3}, {4, 0.6}, {100, 0.6}}) == Approx(0).margin(0.002));
  CHECK(series.rms_difference({{1, 0.33}, {2, 0.43}}) == Approx(0.03).margin(0.002));
}

TEST_CASE("a slump is timed without a change of its heap, and not without being asked") {
  SlumpTest test;
  test.mould = {0.05, 0.035, 0.06};
  test.table_length_m = 0.3;
  test.lift_velocity_m_s = 0.3;
  test.reading.probe_diameter_m = 0.02;
  test.grains.radius_m = test.grains.smallest_m = test.grains.largest_m = 0.006;
  const Outcome plain = simulate(test);
  REQUIRE_FALSE(plain.failure);
  CHECK_FALSE(plain.curve);
  CHECK_FALSE(plain.readings.find("step1.flow_time_s"));

  test.reading.flow = FlowTiming{0.12};
  const Outcome timed = simulate(test);
  REQUIRE_FALSE(timed.failure);
  for (const Reading& one : plain.readings.all()) {
    INFO(one.name);
    CHECK(timed.readings.find(one.name) == one.value);
  }
  const double t = timed.readings.find("step1.t500_s").value(), end = timed.readings.find("step1.flow_time_s").value();
  CHECK(t > 0);
  CHECK(end >= t);
  REQUIRE(timed.curve);
  CHECK(timed.curve->points.front().y == Approx(100).margin(12));
  CHECK(timed.curve->points.back().y == Approx(*plain.readings.find("step1.spread_mm")).margin(2));

  test.reading.flow = FlowTiming{0.29};  // the heap does not get so far
  const Outcome narrow = simulate(test);
  CHECK_FALSE(narrow.readings.find("step1.t500_s"));
  CHECK(narrow.readings.find("step1.flow_time_s") == end);
}
