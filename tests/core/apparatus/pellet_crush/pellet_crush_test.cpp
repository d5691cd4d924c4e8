#include "core/apparatus/pellet_crush/pellet_crush.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/apparatus/granules.h"
#include "core/world/world.h"
#include "tests/core/apparatus/soft_granules.h"

namespace pastefit {
namespace {

double reading_of(const Outcome& outcome, const char* name) {
  return outcome.readings.find(name).value();
}

Outcome done(const PelletCrush& test, const RunOptions& options = {}) {
  REQUIRE(validate(test).empty());
  Outcome outcome = simulate(test, options);
  INFO((outcome.failure ? outcome.failure->message : ""));
  REQUIRE_FALSE(outcome.failure);
  return outcome;
}

/// The faults of a test at one place, in one text.
std::string faults_at(const PelletCrush& test, const std::string& place) {
  std::string text;
  for (const Fault& fault : validate(test))
    if (fault.where == place) text += fault.what + "; " + fault.remedy;
  return text;
}

TEST_CASE("what platen and floor push a pellet with is its weight and its change of momentum") {
  const PelletCrush test = small_pellet(1.0);
  struct Seen {
    double time_s, momentum, weight, push_n, platen_n;
  };
  std::vector<Seen> seen;
  RunOptions options;
  options.watch_interval_s = 0;
  options.watch = [&](const Snapshot& snapshot) {
    if (snapshot.phase != "crush") return true;
    const World& world = *snapshot.world;
    Seen now{snapshot.time_s, 0, 0, 0, world.walls.back().force.z};
    for (std::int32_t i = 0; i < world.particles.count(); ++i) {
      now.momentum += world.particles.mass(i) * world.particles.velocity[i].linear.z;
      now.weight += world.particles.mass(i) * kGravity;
    }
    for (const Wall& wall : world.walls) now.push_n -= wall.force.z;
    seen.push_back(now);
    return true;
  };
  const Outcome outcome = done(test, options);
  REQUIRE(seen.size() > 100);
  double impulse = 0, on_platen = 0;
  for (std::size_t k = 1; k < seen.size(); ++k) {
    const double dt = seen[k].time_s - seen[k - 1].time_s;
    impulse += seen[k].push_n * dt;
    on_platen += seen[k].platen_n * dt;
  }
  const double gained = seen.back().momentum - seen.front().momentum;
  const double duration = seen.back().time_s - seen.front().time_s, weight = seen.back().weight * duration;
  CHECK(impulse == Approx(gained + weight).epsilon(0.01));
  CHECK(on_platen > 10 * std::fabs(gained + weight));

  // The curve is the same force over the die's area.
  double stress_pa = 0;
  for (const CurvePoint& point : outcome.curve->points)
    stress_pa += point.y / static_cast<double>(outcome.curve->points.size());
  CHECK(stress_pa * area_m2(test) == Approx(on_platen / duration).epsilon(0.01));
  const auto peak = std::ranges::max_element(outcome.curve->points, {}, &CurvePoint::y);
  CHECK(reading_of(outcome, "pellet.dynamic_yield_strength_pa") == peak->y);
  CHECK(reading_of(outcome, "pellet.strain_at_peak") == peak->x);
}

TEST_CASE("granules that do not stick make no pellet, and that is what the failure says") {
  const Outcome outcome = simulate(small_pellet(0));
  REQUIRE(outcome.failure);
  CHECK(outcome.failure->reason == FailureReason::fell_apart);
  CHECK(outcome.failure->phase == "release");
  CHECK(outcome.failure->value > outcome.failure->limit);
  CHECK_FALSE(outcome.readings.find("pellet.dynamic_yield_strength_pa"));
}

TEST_CASE("a pellet that the punch takes along is no pellet") {
  PelletCrush test = small_pellet(2.0);
  test.tools.cohesion_factor = 3;
  const Outcome outcome = simulate(test);
  REQUIRE(outcome.failure);
  CHECK(outcome.failure->reason == FailureReason::fell_apart);
  CHECK(outcome.failure->phase == "withdraw");
  CHECK_THAT(outcome.failure->message, Catch::Contains("stick to the punch"));
}

TEST_CASE("a pellet is the stronger the more its granules stick, and springs back when the punch is withdrawn") {
  const PelletCrush weak = small_pellet(0.5), strong = small_pellet(2.0);
  const Outcome of_weak = done(weak), of_strong = done(strong);
  const double ratio = reading_of(of_strong, "pellet.dynamic_yield_strength_pa") /
                       reading_of(of_weak, "pellet.dynamic_yield_strength_pa");
  CHECK(ratio > 2);
  CHECK(ratio < 8);
  for (const Outcome* outcome : {&of_weak, &of_strong}) {
    CHECK(reading_of(*outcome, "pellet.height_mm") > 1e3 * weak.pressed_height_m);
    CHECK(reading_of(*outcome, "pellet.height_mm") < 1e3 * weak.fill_height_m);
  }
  const double solid_m3 = reading_of(of_weak, "die.mass_g") * 1e-3 / weak.bulk_density_kg_m3;
  CHECK(reading_of(of_weak, "die.solid_fraction") == Approx(solid_m3 / filled_volume_m3(weak)));
}

TEST_CASE("the bits of a pellet crush do not depend on the number of threads, but on the packing") {
  PelletCrush test = small_pellet(1.0);
  const Outcome one = done(test);
  for (const int threads : {2, 3}) {
    RunOptions options;
    options.steps.threads = threads;
    const Outcome shared = done(test, options);
    for (const Reading& reading : one.readings.all()) CHECK(shared.readings.find(reading.name) == reading.value);
  }
  test.packing_seed = 2;
  CHECK(reading_of(done(test), "pellet.dynamic_yield_strength_pa") !=
        reading_of(one, "pellet.dynamic_yield_strength_pa"));
}

TEST_CASE("a pellet crush that says nothing is refused, with the place and what would be right") {
  PelletCrush test = small_pellet(1.0);
  test.grains.radius_m = 0.0006;
  CHECK_THAT(faults_at(test, "grains.radius_m"), Catch::Contains("one of a few granules"));
  test = small_pellet(1.0);
  test.press_speedup = 1e4;
  CHECK_THAT(faults_at(test, "press_speedup"), Catch::Contains("but sound in a bed of these granules"));
  CHECK_THAT(faults_at(test, "platen_speed_m_s"), Catch::Equals(""));
  test = small_pellet(1.0);
  test.pressed_height_m = 0.008;
  CHECK_THAT(faults_at(test, "pressed_height_m"), Catch::Contains("above the fill height"));
  test = small_pellet(1.0);
  test.grains = {SizeDistribution::normal, 0.0005, 0.0004, 0.0005, 0.000501};
  CHECK_THAT(faults_at(test, "grains.standard_deviation_m"), Catch::Contains("between smallest and largest"));
}

TEST_CASE("sound runs through a row of granules as its springs and masses let it") {
  const PelletCrush test = small_pellet(1.0);
  // A chain of masses m and springs k at a distance 2R: 2R sqrt(k/m), k = d(4/3 E* sqrt(R*) d^1.5)/dd at d = 0.02 R.
  const double e_star = 2.4e6 / (2 * (1 - 0.2 * 0.2)), radius = 0.0005;
  const double spring = 2 * e_star * std::sqrt(0.5 * radius * 0.02 * radius);
  const double mass = 1000 * 4.0 / 3 * std::acos(-1) * std::pow(radius, 3);
  CHECK(sound_speed_m_s(test) == Approx(2 * radius * std::sqrt(spring / mass)));
}

}  // namespace
}  // namespace pastefit
