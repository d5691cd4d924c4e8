#include "core/observe/heap.h"

#include <catch2/catch.hpp>

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

TEST_CASE("the height at the axis is that of the grains' tops, not of the pits between them") {
  const Particles grains = carpet(0.004, 0.1, 0.12, 0);
  CHECK(height_at_axis(grains, 0.004, 0.04) == Approx(0.12).margin(0.0007));
  CHECK(highest_point(grains) == Approx(0.12).epsilon(1e-12));
}

TEST_CASE("the spread is the size of the body, without a grain that rolled away") {
  std::vector<Vec3> centres;
  for (double x = -0.1; x <= 0.1001; x += 0.008)
    for (double y = -0.06; y <= 0.0601; y += 0.008) centres.push_back({x, y, 0.004});
  const double expected = 0.5 * ((0.2 + 0.008) + (0.12 + 0.008));
  CHECK(spread_diameter(make_particles(centres, std::vector<double>(centres.size(), 0.004), 2000), 0.004) ==
        Approx(expected).epsilon(1e-6));
  centres.push_back({0.3, 0, 0.004});
  CHECK(spread_diameter(make_particles(centres, std::vector<double>(centres.size(), 0.004), 2000), 0.004) ==
        Approx(expected).epsilon(1e-6));
}

TEST_CASE("the plateau's sag is the height of its hinge side over its free side") {
  const Plateau level = plateau(carpet(0.004, 0.06, 0.1, 0), 0.004, 0.04, 0.2);
  CHECK(std::fabs(level.sag) < 1e-3);
  CHECK(level.width == Approx(0.12).margin(0.012));
  const Plateau tilted = plateau(carpet(0.004, 0.06, 0.1, -0.1), 0.004, 0.04, 0.2);
  CHECK(tilted.sag == Approx(0.1 * tilted.width).epsilon(0.1));
}

TEST_CASE("an empty table reads zero") {
  const Particles none = make_particles({}, {}, 2000);
  CHECK(highest_point(none) == 0);
  CHECK(height_at_axis(none, 0.004, 0.04) == 0);
  CHECK(spread_diameter(none, 0.004) == 0);
}
