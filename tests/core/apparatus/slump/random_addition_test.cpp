#include "core/apparatus/slump/random_addition.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/apparatus/specimen.h"

using namespace pastefit;

namespace {

constexpr double solid_fraction = 0.25;
const Mould abrams_cone{0.1, 0.05, 0.3};
const Mould cone_upside_down{0.05, 0.1, 0.3};

std::vector<double> drawn_radii(std::size_t count) {
  const GrainSizes sizes{SizeDistribution::uniform, 0.006, 0, 0.003, 0.009};
  std::vector<double> radii;
  for (std::size_t n = 0; n < count; ++n) radii.push_back(draw_radius(sizes, 1, n));
  return radii;
}

double highest_of(const std::vector<Vec3>& centres) {
  double highest = 0;
  for (const Vec3& centre : centres) highest = std::max(highest, centre.z);
  return highest;
}

}  // namespace

TEST_CASE("random addition: no sphere meets another, the floor or the side of the mould") {
  const auto radii = drawn_radii(1500);
  for (const Mould& mould : {abrams_cone, cone_upside_down}) {
    const auto centres = random_addition(mould, radii, solid_fraction, 1);
    REQUIRE(centres.size() == radii.size());
    const double lean = std::atan((mould.base_radius_m - mould.top_radius_m) / mould.height_m);
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const Vec3& p = centres[i];
      CHECK(p.z >= radii[i]);
      CHECK((inner_radius(mould, p.z) - std::hypot(p.x, p.y)) * std::cos(lean) >= radii[i] * (1 - 1e-12));
      for (std::size_t j = 0; j < i; ++j)
        if (norm(centres[j] - p) < radii[i] + radii[j]) FAIL("spheres " << j << " and " << i << " meet");
    }
  }
}

TEST_CASE("random addition fills mould and hopper evenly, as densely as is asked") {
  const auto radii = drawn_radii(4000);
  const auto centres = random_addition(abrams_cone, radii, solid_fraction, 1);
  // Slices away from floor and top, where spheres keep their distance.
  for (const double below : {0.03, 0.12, 0.21, 0.35}) {
    const double above = below + 0.08;
    double solid = 0, room = 0;
    for (std::size_t i = 0; i < centres.size(); ++i)
      if (centres[i].z >= below && centres[i].z < above) solid += sphere_volume_m3(radii[i]);
    constexpr int kLayers = 100;
    for (int layer = 0; layer < kLayers; ++layer)
      room += std::numbers::pi * std::pow(inner_radius(abrams_cone, below + (layer + 0.5) * 0.08 / kLayers), 2) * 0.08 /
              kLayers;
    INFO("between " << below << " and " << above << " m");
    CHECK(solid / room == Approx(solid_fraction).epsilon(0.15));
  }
}

TEST_CASE("random addition: a seed gives the same places, another one others") {
  const auto radii = drawn_radii(300);
  const auto once = random_addition(abrams_cone, radii, solid_fraction, 1);
  const auto again = random_addition(abrams_cone, radii, solid_fraction, 1);
  const auto other = random_addition(abrams_cone, radii, solid_fraction, 2);
  CHECK(norm(once.back() - again.back()) == 0);
  CHECK(norm(once.front() - other.front()) > 0);
}

TEST_CASE("random addition: spheres that find no place any more are put higher up") {
  const std::vector<double> radii(1500, 0.008);  // at 0.6, no more than the mould holds
  const auto centres = random_addition(abrams_cone, radii, 0.6, 1);
  CHECK(centres.size() == radii.size());
  CHECK(highest_of(centres) > abrams_cone.height_m);
}
