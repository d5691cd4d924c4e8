#include "core/observe/heap.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/observe/outline.h"

using namespace pastefit;

namespace {

/// Grains on a square lattice whose tops lie on a plane z = height + tilt x, over |x|, |y| <= half.
Particles carpet(double radius, double half, double height, double tilt) {
  std::vector<Vec3> centres;
  for (double x = -half; x <= half; x += 1.5 * radius)
    for (double y = -half; y <= half; y += 1.5 * radius) centres.push_back({x, y, height + tilt * x - radius});
  return make_particles(centres, std::vector<double>(centres.size(), radius), 2000);
}

}  // namespace

TEST_CASE("the height over a disc is that of the grains' tops, not of the pits between them, wherever it lies") {
  const Particles level = carpet(0.004, 0.1, 0.12, 0);
  CHECK(mean_height(level, 0.004, {0, 0, 0.04}) == Approx(0.12).margin(0.0007));
  CHECK(highest_point(level) == Approx(0.12).epsilon(1e-12));
  const Particles tilted = carpet(0.004, 0.1, 0.12, -0.2);
  CHECK(mean_height(tilted, 0.004, {0.03, 0.01, 0.04}) == Approx(0.12 - 0.2 * 0.03).margin(0.001));
}

TEST_CASE("the spread is the size of the body, without a grain that rolled away") {
  std::vector<Vec3> centres;
  for (double x = -0.1; x <= 0.1001; x += 0.008)
    for (double y = -0.06; y <= 0.0601; y += 0.008) centres.push_back({x, y, 0.004});
  // Width of a rectangle a x b in direction t: a |cos t| + b |sin t|, mean 2 (a + b)/pi over all t.
  const double orthogonal = 0.5 * (0.2 + 0.12) + 0.008, mean = 2 * (0.2 + 0.12) / std::numbers::pi + 0.008;
  for (const bool rolled_away : {false, true}) {
    if (rolled_away) centres.push_back({0.3, 0, 0.004});
    const Widths spread = widths(make_particles(centres, std::vector<double>(centres.size(), 0.004), 2000), 0.004);
    CHECK(spread.orthogonal == Approx(orthogonal).epsilon(1e-6));
    CHECK(spread.mean == Approx(mean).epsilon(0.002));
  }
}

TEST_CASE("of grains that scattered, with or without one on the axis, the spread is that of them all") {
  for (const bool on_axis : {false, true}) {
    std::vector<Vec3> centres;
    if (on_axis) centres.push_back({0, 0, 0.004});
    for (double x = -0.15; x <= 0.1501; x += 0.03)
      for (double y = -0.15; y <= 0.1501; y += 0.03) centres.push_back({x, y + 0.005, 0.004});
    const Widths spread = widths(make_particles(centres, std::vector<double>(centres.size(), 0.004), 2000), 0.004);
    CHECK(spread.orthogonal == Approx(0.308).epsilon(1e-6));
  }
}

TEST_CASE("the slope of a top is that of the plane through its grains") {
  const auto slope = [](double tilt) { return slope_along_x(carpet(0.004, 0.08, 0.1, tilt), 0.004, {0, 0, 0.1}); };
  CHECK(std::fabs(slope(0)) < 1e-3);
  CHECK(slope(-0.1) == Approx(-0.1).epsilon(0.02));
}

TEST_CASE("an empty table reads zero") {
  const Particles none = make_particles({}, {}, 2000);
  CHECK(highest_point(none) == 0);
  CHECK(mean_height(none, 0.004, {0, 0, 0.04}) == 0);
  CHECK(widths(none, 0.004).mean == 0);
  CHECK(outline(none, 0.004).at(0) == 0);
}

namespace {

/// A layer of grains whose tops lie on a cone of this slope about (x, y), on the table.
Particles cone_of_grains(double radius, double height, double slope, double x = 0, double y = 0) {
  std::vector<Vec3> centres;
  const double foot = height / slope;
  for (double dx = -foot; dx <= foot; dx += 1.2 * radius)
    for (double dy = -foot; dy <= foot; dy += 1.2 * radius) {
      const double z = height - slope * std::hypot(dx, dy) - radius;
      if (z >= 0) centres.push_back({x + dx, y + dy, z});
    }
  return make_particles(centres, std::vector<double>(centres.size(), radius), 2000);
}

}  // namespace

TEST_CASE("the angle of repose is that of the cone on which the grains lie, wherever it stands") {
  for (const double angle : {12.0, 20.0, 28.0, 36.0}) {
    const double slope = std::tan(angle * std::numbers::pi / 180);
    for (const double x : {0.0, 0.037}) {
      INFO(angle << " about " << x);
      const auto read = flank_angle(cone_of_grains(0.002, 0.08, slope, x, -x), 0.002, 0.2, 0.8);
      REQUIRE(read);
      CHECK(180 / std::numbers::pi * *read == Approx(angle).margin(0.3));
    }
  }
}

TEST_CASE("the angle of repose is that of the part of the flank that is asked for") {
  // Below half of its height the heap is steeper: slope 0.6 under a cone of slope 0.3.
  std::vector<Vec3> centres;
  for (double x = -0.25; x <= 0.25; x += 0.0024)
    for (double y = -0.25; y <= 0.25; y += 0.0024) {
      const double r = std::hypot(x, y), z = std::min(0.08 - 0.3 * r, 0.12 - 0.6 * r) - 0.002;
      if (z >= 0) centres.push_back({x, y, z});
    }
  const Particles heap = make_particles(centres, std::vector<double>(centres.size(), 0.002), 2000);
  CHECK(std::tan(flank_angle(heap, 0.002, 0.1, 0.4).value()) == Approx(0.6).epsilon(0.05));
  CHECK(std::tan(flank_angle(heap, 0.002, 0.6, 0.9).value()) == Approx(0.3).epsilon(0.05));
}

TEST_CASE("grains that have rolled away do not change the angle of repose; a layer of grains has none") {
  Particles heap = cone_of_grains(0.002, 0.06, 0.5);
  const double angle = flank_angle(heap, 0.002, 0.2, 0.8).value();
  std::vector<Vec3> centres;
  for (std::int32_t i = 0; i < heap.count(); ++i) centres.push_back(heap.motion[i].position);
  for (int k = -8; k <= 8; ++k)
    if (k != 0) centres.push_back({0.05 * k, 0.4, 0.002});
  const Particles scattered = make_particles(centres, std::vector<double>(centres.size(), 0.002), 2000);
  CHECK(flank_angle(scattered, 0.002, 0.2, 0.8).value() == Approx(angle).margin(0.005));
  CHECK_FALSE(flank_angle(carpet(0.004, 0.1, 0.008, 0), 0.004, 0.2, 0.8));
  CHECK_FALSE(flank_angle(make_particles({}, {}, 2000), 0.004, 0.2, 0.8));
}
