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
