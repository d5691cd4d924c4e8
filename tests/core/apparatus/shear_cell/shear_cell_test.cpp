#include "core/apparatus/shear_cell/shear_cell.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/world/world.h"
#include "tests/core/apparatus/soft_granules.h"

namespace pastefit {
namespace {

double value_of(const Outcome& outcome, const char* name) {
  return outcome.readings.find(name).value();
}

Outcome sheared(const ShearCell& test, const RunOptions& options = {}) {
  for (const Fault& fault : validate(test)) FAIL(fault.where + ": " + fault.what);
  Outcome outcome = simulate(test, options);
  INFO((outcome.failure ? outcome.failure->phase + ": " + outcome.failure->message : ""));
  REQUIRE_FALSE(outcome.failure);
  return outcome;
}

/// The faults of a cell at one place, in one text.
std::string refusals_at(const ShearCell& test, const std::string& place) {
  std::string text;
  for (const Fault& fault : validate(test))
    if (fault.where == place) text += fault.what + "; " + fault.remedy;
  return text;
}

TEST_CASE("the bed carries the lid's load while it is sheared, and passes on from the base what drags the lid") {
  const ShearCell test = small_cell(0.5);
  double duration = 0, before = 0, on_lid = 0, on_base = 0, along_lid = 0, weight = 0, height = 0, rise = 0;
  RunOptions options;
  options.watch_interval_s = 0;
  options.watch = [&](const Snapshot& snapshot) {
    if (snapshot.phase != "shear") return true;
    const World& world = *snapshot.world;
    weight = 0;
    for (std::int32_t i = 0; i < world.particles.count(); ++i) weight += world.particles.mass(i) * kGravity;
    const double dt = before > 0 ? snapshot.time_s - before : 0;
    before = snapshot.time_s;
    duration += dt;
    const double now = std::get<Plane>(world.walls[4].shape).point.z;
    if (height > 0) rise += now - height;
    height = now;
    on_lid += dt * (world.walls[4].force.z + world.walls[5].force.z);
    along_lid += dt * (world.walls[4].force.x + world.walls[5].force.x);
    on_base += dt * (world.walls[0].force.x + world.walls[1].force.x);
    return true;
  };
  const Outcome outcome = sheared(test, options);
  REQUIRE(duration > 0.1);
  const double load = test.normal_stress_pa * area_m2(test);
  // Of a lid that rises the dashpot takes a share, as much of the load as its mean speed is of the bound; its inertia
  // counts for the ends of the run only.
  CHECK(std::fabs(rise / duration / test.lid_speed_m_s) < 0.05);
  CHECK(on_lid / duration == Approx(load * (1 + rise / duration / test.lid_speed_m_s)).epsilon(1e-3));
  // What the base gives goes into the lid but for the bed's momentum, which is at most all of it at the base's speed.
  const double all = weight / kGravity * test.shear_speedup * test.shear_speed_m_s;
  CHECK(std::fabs(on_base + along_lid) < all + 0.01 * along_lid);
  CHECK(along_lid > 20 * all);
  double stress = 0;
  for (const CurvePoint& point : outcome.curve->points)
    stress += point.y / static_cast<double>(outcome.curve->points.size());
  CHECK(stress * area_m2(test) == Approx(along_lid / duration).epsilon(0.02));
}

TEST_CASE("granules that do not stick resist shear in proportion to the load, and those that stick by more") {
  // From one packing to the next the stress of so small a cell scatters by more than its own error says.
  constexpr int kPackings = 8;
  double once = 0, ratio = 0, square = 0;
  ShearCell test = small_cell(0);
  const double pressed = test.normal_stress_pa;
  for (int packing = 0; packing < kPackings; ++packing) {
    test.packing_seed = 1 + packing;
    test.normal_stress_pa = pressed;
    const Outcome simple = sheared(test);
    CHECK(value_of(simple, "shear.peak_stress_pa") >= value_of(simple, "shear.stress_pa"));
    test.normal_stress_pa = 2 * pressed;
    const double r = value_of(sheared(test), "shear.stress_pa") / value_of(simple, "shear.stress_pa");
    once += value_of(simple, "shear.stress_pa") / kPackings;
    ratio += r / kPackings;
    square += r * r / kPackings;
  }
  const double error = std::sqrt((square - ratio * ratio) / (kPackings - 1));
  CHECK(ratio == Approx(2).margin(3 * error));
  CHECK(error < 0.15);
  CHECK(once / pressed > 0.2);
  CHECK(once / pressed < 0.8);
  const Outcome sticky = sheared(small_cell(1.5));
  CHECK(value_of(sticky, "shear.stress_pa") > 1.2 * once);
}

// Right after the filling next to nothing has been put in by the lid: the audit has to know what the fall put in.
TEST_CASE("a cell can be sheared whatever its packing") {
  ShearCell test = small_cell(0);
  test.final_displacement_m = 0.0005;
  for (test.packing_seed = 1; test.packing_seed <= 20; ++test.packing_seed) {
    INFO(test.packing_seed);
    const Outcome outcome = simulate(test, {});
    CHECK((outcome.failure ? outcome.failure->message : "").empty());
  }
}

TEST_CASE("the bits of a shear cell do not depend on the number of threads, but on the packing") {
  ShearCell test = small_cell(0.5);
  test.final_displacement_m = 0.001;
  const Outcome alone = sheared(test);
  RunOptions options;
  options.steps.threads = 2;
  const Outcome shared = sheared(test, options);
  for (const Reading& reading : alone.readings.all()) CHECK(shared.readings.find(reading.name) == reading.value);
  test.packing_seed = 2;
  CHECK(value_of(sheared(test), "shear.stress_pa") != value_of(alone, "shear.stress_pa"));
}

TEST_CASE("a shear cell that says nothing is refused, with the place and what would be right") {
  ShearCell test = small_cell(1);
  test.grains.radius_m = 0.0006;
  CHECK_THAT(refusals_at(test, "grains.radius_m"), Catch::Contains("one of a few granules"));
  test = small_cell(1);
  test.normal_stress_pa = -2000;
  CHECK_THAT(refusals_at(test, "normal_stress_pa"), Catch::Contains("from 1 to 1e+07 Pa"));
  test = small_cell(1);
  test.shear_speedup = 1e5;
  CHECK_THAT(refusals_at(test, "shear_speedup"), Catch::Contains("but sound in a bed of these granules"));
  CHECK_THAT(refusals_at(test, "shear_speedup"), Catch::Contains("inertial number"));
  test = small_cell(1);
  test.base_ribs.pitch_m = 0.0012;
  CHECK_THAT(refusals_at(test, "base_ribs.pitch_m"), Catch::Contains("less than a granule"));
  test = small_cell(1);
  test.lid_ribs.height_m = 0.006;
  CHECK_THAT(refusals_at(test, "fill_height_m"), Catch::Contains("would meet"));
}

TEST_CASE("ribs stand evenly over the length of a cell, as near to their pitch as that allows") {
  CHECK(even_pitch_m({0, 0, 0.00535}, 0.018) == Approx(0.006));
  CHECK(even_pitch_m({0, 0, 0.0105}, 0.018) == Approx(0.009));
  CHECK(even_pitch_m({0, 0, 0.017}, 0.018) == Approx(0.018));
}

}  // namespace
}  // namespace pastefit
