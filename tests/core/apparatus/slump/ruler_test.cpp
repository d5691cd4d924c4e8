#include "core/apparatus/slump/ruler.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace pastefit;

TEST_CASE("a table covered to its corners is read as long as it is, one not covered as wide as its heap") {
  SlumpTest test;
  test.table_length_m = 0.4;
  // A square of side a is 4 a/pi wide in the mean over all directions: more than the table that it covers.
  const auto spread_mm = [&](double half) {
    std::vector<Vec3> centres;
    for (double x = -half; x <= half + 1e-9; x += 0.01)
      for (double y = -half; y <= half + 1e-9; y += 0.01) centres.push_back({x, y, 0.005});
    const Particles grains = make_particles(centres, std::vector<double>(centres.size(), 0.005), 2000);
    Readings readings;
    Ruler(test, 0, grains).read(grains, "step1", readings);
    return *readings.find("step1.spread_mm");
  };
  CHECK(spread_mm(0.195) == Approx(400));
  CHECK(spread_mm(0.1) == Approx(1e3 * (8 * 0.1 / std::numbers::pi + 0.01)).epsilon(0.002));
}

TEST_CASE("the angle of repose is read after step 1, and only where it is asked for") {
  SlumpTest test;
  std::vector<Vec3> centres;
  for (double x = -0.15; x <= 0.1501; x += 0.003)
    for (double y = -0.15; y <= 0.1501; y += 0.003)
      if (const double z = 0.06 - 0.4 * std::sqrt(x * x + y * y); z >= 0) centres.push_back({x, y, z});
  test.grains.radius_m = test.grains.smallest_m = test.grains.largest_m = 0.0025;
  const Particles heap = make_particles(centres, std::vector<double>(centres.size(), 0.0025), 2000);
  const auto angle = [&](const char* step) {
    Readings readings;
    Ruler(test, 0, heap).read(heap, step, readings);
    return readings.find(std::string(step) + ".angle_of_repose_deg");
  };
  CHECK_FALSE(angle("step1"));
  test.reading.flank.emplace();
  REQUIRE(angle("step1"));
  CHECK(*angle("step1") == Approx(180 / std::numbers::pi * std::atan(0.4)).margin(0.5));
  CHECK_FALSE(angle("step2"));
}

TEST_CASE("the shift of a top is read, also where soft grains carry it below the rim") {
  SlumpTest test;
  test.grains.radius_m = 0.005;
  for (const double sunk : {0.0, 0.03}) {
    std::vector<Vec3> centres;
    for (double x = -0.05; x <= 0.0501; x += 0.01)
      for (double y = -0.05; y <= 0.0501; y += 0.01)
        for (double z = 0.005; z < test.mould.height_m - sunk; z += 0.01) centres.push_back({x, y, z});
    const std::vector<double> radii(centres.size(), 0.005);
    const Particles in_mould = make_particles(centres, radii, 2000);
    for (Vec3& centre : centres) centre.x += 0.02;
    Readings readings;
    Ruler(test, 0, in_mould).read(make_particles(centres, radii, 2000), "step1", readings);
    INFO("sunk by " << sunk << " m");
    CHECK(*readings.find("step1.lateral_shift_mm") == Approx(20));
  }
}
