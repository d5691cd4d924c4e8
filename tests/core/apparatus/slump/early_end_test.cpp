#include <catch2/catch.hpp>

#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"
#include "tests/core/apparatus/slump/bridges.h"

using namespace pastefit;

namespace {

/// A paste of coarse grains that slumps to about half, or with `drop` on a drop plate. The ruler reads the highest
/// point.
SlumpTest slumping(bool drop) {
  SlumpTest test;
  test.grains.radius_m = 0.014;
  test.lift_velocity_m_s = 0.2;
  test.reading.height = HeightReading::highest;
  test.contact.friction = 0.2;
  const double r = test.grains.radius_m, c = 2000 * r * r;
  test.contact.bridge = parabolic_bridge(c, 0.4 * r);
  if (drop) test.drop = DropPlate{};
  return test;
}

/// The test without a cutoff.
Outcome whole_run(const SlumpTest& test, std::shared_ptr<const Packing> packing) {
  RunOptions options;
  options.packing = std::move(packing);
  Outcome whole = simulate(test, options);
  REQUIRE_FALSE(whole.failure);
  return whole;
}

Outcome run(const SlumpTest& test, std::shared_ptr<const Packing> packing, double lowest_mm, double highest_mm = 1e9) {
  RunOptions options;
  options.packing = std::move(packing);
  options.cutoff = Cutoff{"step1.height_mm", lowest_mm, highest_mm};
  return simulate(test, options);
}

}  // namespace

TEST_CASE("a heap that has sunk below its cutoff ends early, and only such a one") {
  const SlumpTest test = slumping(false);
  const auto packing = fill_mould(test);
  const Outcome whole = whole_run(test, packing);
  const double height = whole.readings.find("step1.height_mm").value();
  REQUIRE(height > 60);
  REQUIRE(height < 170);

  // Far below: the run ends while the heap still sinks, and reads nothing of it.
  const Outcome lost = run(test, packing, height + 35);
  CHECK_FALSE(lost.failure);
  CHECK(lost.run.ended_early);
  CHECK(lost.run.steps < whole.run.steps);
  CHECK_FALSE(lost.readings.find("step1.height_mm"));
  CHECK(lost.readings.find("fill.mass_kg") == whole.readings.find("fill.mass_kg"));

  // Within the cutoff by a hair: the same bits as without a cutoff.
  const Outcome kept = run(test, packing, height - 0.001);
  CHECK_FALSE(kept.run.ended_early);
  CHECK(kept.run.steps == whole.run.steps);
  CHECK(kept.readings.find("step1.height_mm") == height);
  CHECK(kept.readings.find("step1.spread_mm") == whole.readings.find("step1.spread_mm"));
}

TEST_CASE("no heap that ends early would have read more than the lower end of its cutoff", "[campaign]") {
  for (const double strength : {500.0, 1500.0, 4000.0, 9000.0}) {
    SlumpTest test = slumping(false);
    Bridge& bridge = test.contact.bridge;
    const double factor = strength / 2000;
    bridge.a_n_m2 *= factor;
    bridge.b_n_m *= factor;
    bridge.c_n *= factor;
    const auto packing = fill_mould(test);
    const double height = whole_run(test, packing).readings.find("step1.height_mm").value();
    for (double lowest = 20; lowest < 200; lowest += 20) {
      CAPTURE(strength, height, lowest);
      if (run(test, packing, lowest).run.ended_early) CHECK(height < lowest);
    }
  }
}

TEST_CASE("step 2 is not run where step 1 reads beyond the cutoff on either side") {
  const SlumpTest test = slumping(true);
  const auto packing = fill_mould(test);
  const Outcome whole = whole_run(test, packing);
  const double height = whole.readings.find("step1.height_mm").value();
  const Outcome above = run(test, packing, 0, height - 0.001), below = run(test, packing, height + 0.001);
  for (const Outcome& ended : {above, below}) {
    CHECK(ended.run.ended_early);
    CHECK(ended.run.steps < whole.run.steps);
    CHECK(ended.readings.find("step1.height_mm") == height);
    CHECK(ended.readings.find("step1.spread_mm") == whole.readings.find("step1.spread_mm"));
    CHECK_FALSE(ended.readings.find("step2.height_mm"));
  }
  const Outcome within = run(test, packing, height - 0.001, height + 0.001);
  CHECK_FALSE(within.run.ended_early);
  CHECK(within.readings.find("step2.height_mm") == whole.readings.find("step2.height_mm"));
}
