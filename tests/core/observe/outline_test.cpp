#include "core/observe/outline.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace pastefit;

namespace {

/// A cone of grains on a lattice: height 0.1 at the axis, none at 0.1 from it.
Particles cone(double radius) {
  std::vector<Vec3> centres;
  for (double x = -0.1; x <= 0.1; x += 1.2 * radius)
    for (double y = -0.1; y <= 0.1; y += 1.2 * radius) {
      const double top = 0.1 - std::hypot(x, y);
      if (top > radius) centres.push_back({x, y, top - radius});
    }
  return make_particles(centres, std::vector<double>(centres.size(), radius), 2000);
}

}  // namespace

TEST_CASE("the outline of a cone is a triangle, and its difference from the triangle is of a grain's size") {
  const double radius = 0.002;
  const Outline side = outline(cone(radius), radius);
  for (const double x : {-0.07, -0.03, 0.0, 0.04, 0.08}) CHECK(side.at(x) == Approx(0.1 - std::fabs(x)).margin(radius));
  CHECK(side.at(-0.2) == 0);
  CHECK(side.at(0.2) == 0);
  CHECK(rms_difference(side, {{-0.09, 0.01}, {0, 0.1}, {0.09, 0.01}}) < radius);
}

TEST_CASE("an outline that lies ten millimetres beside another differs from it by ten") {
  const double radius = 0.002;
  const Outline side = outline(cone(radius), radius);
  std::vector<OutlinePoint> shifted;
  for (double x = -0.05; x < 0.051; x += 0.01) shifted.push_back({x, side.at(x) + 0.01});
  CHECK(rms_difference(side, shifted) == Approx(0.01).epsilon(0.1));
}

TEST_CASE("the plateau is what stands at 0.8 of the middle's height") {
  const double radius = 0.002;
  CHECK(plateau_width(outline(cone(radius), radius)) == Approx(2 * 0.02).margin(2 * radius));
}
