#include "core/apparatus/slump/slump_test.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "core/apparatus/slump/packing.h"
#include "core/observe/outline.h"
#include "core/world/world.h"
#include "tests/core/apparatus/slump/bridges.h"

using namespace pastefit;

namespace {

/// The EN 12350-5 cone filled with coarse grains: a test of a second.
SlumpTest small_test(double strength_in_weights) {
  SlumpTest test;
  test.grains.radius_m = 0.012;
  test.lift_velocity_m_s = 0.2;
  const double r = test.grains.radius_m;
  const double weight = test.bulk_density_kg_m3 / 0.6 * 4.19 * r * r * r * 9.81;
  const double c = strength_in_weights * weight;
  if (c > 0) test.contact.bridge = parabolic_bridge(c, 0.3 * r);
  return test;
}

}  // namespace

TEST_CASE("the mould is filled level with its rim") {
  const auto packing = fill_mould(small_test(0));
  REQUIRE_FALSE(packing->failure);
  double top = 0;
  for (std::size_t i = 0; i < packing->radii.size(); ++i)
    top = std::max(top, packing->centres[i].z + packing->radii[i]);
  CHECK(top == Approx(0.2).margin(0.002));
  const double fraction = packing->solid_volume_m3 / volume_m3(Mould{});
  CHECK(fraction > 0.54);
  CHECK(fraction < 0.64);
}

TEST_CASE("as many grains fill the mould as is foretold, whatever their sizes") {
  SlumpTest wide = small_test(0);
  wide.grains = {SizeDistribution::uniform, 0.010, 0, 0.007, 0.013};
  for (const SlumpTest& test : {small_test(0), small_test(30), wide}) {
    std::int64_t drawn = 0;
    RunOptions options;
    options.watch = [&](const Snapshot& snapshot) {
      drawn = snapshot.world->particles.count();
      return false;
    };
    (void)fill_mould(test, options);
    CHECK(grains_needed(test) == Approx(static_cast<double>(drawn)).epsilon(0.05));
  }
}

TEST_CASE("tests with like frictions share a fill; a fill of its own feels the test's own laws") {
  SlumpTest smooth = small_test(0), rough = small_test(0);
  smooth.contact.friction = 0.21;
  rough.contact.friction = 0.29;
  RunOptions own;
  own.own_fill = true;
  const auto height = [](const SlumpTest& test, const RunOptions& options) {
    const auto packing = fill_mould(test, options);
    REQUIRE_FALSE(packing->failure);
    return packing->centres.front().z;
  };
  CHECK(height(smooth, {}) == height(rough, {}));
  CHECK(height(smooth, own) != height(rough, own));
  smooth.contact.friction = 0;
  const double packed = fill_mould(smooth, own)->solid_volume_m3 / fill_mould(rough, own)->solid_volume_m3;
  CHECK(packed > 1.01);
}

TEST_CASE("with a fixed wait the phases last as long whatever the heap does") {
  RunOptions options;
  options.fixed_wait_s = 0.3;
  const SlumpTest test = small_test(30);
  options.packing = fill_mould(test);
  std::vector<std::pair<std::string, double>> begun;
  options.watch_interval_s = 1e-4;
  options.watch = [&](const Snapshot& snapshot) {
    if (begun.empty() || begun.back().first != snapshot.phase) begun.emplace_back(snapshot.phase, snapshot.time_s);
    return true;
  };
  const Outcome outcome = simulate(test, options);
  REQUIRE_FALSE(outcome.failure);
  CHECK_FALSE(outcome.run.settled);
  REQUIRE(begun.size() == 3);
  CHECK(begun[0].first == "fill.settle");
  CHECK(begun[1].second == 0);
  CHECK(begun[2].second == Approx(1.0).margin(2e-3));
  CHECK(outcome.run.simulated_s == Approx(1.3).margin(4e-3));
}

TEST_CASE("dry grains slump, sticky ones stand, and in step 2 the heap gets lower") {
  SlumpTest dry = small_test(0), strong = small_test(30);
  dry.drop = DropPlate{};
  const Outcome flat = simulate(dry), upright = simulate(strong);
  REQUIRE_FALSE(flat.failure);
  REQUIRE_FALSE(upright.failure);
  CHECK(flat.run.settled);
  CHECK(*flat.readings.find("step1.height_mm") < 90);
  CHECK(*upright.readings.find("step1.height_mm") > 180);
  CHECK(*flat.readings.find("step2.height_mm") < *flat.readings.find("step1.height_mm"));
  CHECK(*flat.readings.find("step1.spread_mm") > 300);
  const std::vector<std::string> names = reading_names(dry);
  REQUIRE(names.size() == flat.readings.all().size());
  for (std::size_t k = 0; k < names.size(); ++k) CHECK(names[k] == flat.readings.all()[k].name);
}

TEST_CASE("the mould holds the laboratory's mass whatever the packing") {
  const SlumpTest test = small_test(1);
  const Outcome outcome = simulate(test);
  CHECK(*outcome.readings.find("fill.mass_kg") == Approx(test.bulk_density_kg_m3 * volume_m3(test.mould)));
}

TEST_CASE("the same test gives the same bits, another packing others") {
  SlumpTest test = small_test(1);
  const double first = *simulate(test).readings.find("step1.height_mm");
  const double again = *simulate(test).readings.find("step1.height_mm");
  test.packing_seed = 2;
  const double other = *simulate(test).readings.find("step1.height_mm");
  CHECK(std::memcmp(&first, &again, sizeof first) == 0);
  CHECK(first != other);
}

TEST_CASE("the energy of a slump in two steps is accounted for to the second order of the step, dry and sticky") {
  for (const double strength : {0.0, 5.0}) {
    SlumpTest test = small_test(strength);
    test.drop = DropPlate{};
    const auto error_with = [&](double impact_resolution) {
      RunOptions options;
      options.steps.impact_resolution = impact_resolution;
      options.packing = fill_mould(test);
      const Outcome outcome = simulate(test, options);
      REQUIRE_FALSE(outcome.failure);
      return std::fabs(outcome.run.energy_error.value());
    };
    const double coarse = error_with(StepOptions{}.impact_resolution), fine = error_with(40);
    INFO("strength in weights " << strength << ": " << coarse << " at the default step, " << fine << " at a quarter");
    CHECK(fine < 2e-4);
    CHECK(coarse < 16 * 2e-4);
  }
}

TEST_CASE(
    "a bridge pulls grains shut without making energy, whatever holds them in overlap, at any strength and size") {
  for (const double radius : {0.012, 0.006})
    for (const double strength_pa : {1e4, 4e4})
      for (const double cohesion_ratio : {0.0, 0.3, 0.5, 3.0}) {
        SlumpTest test = small_test(1);
        test.grains.radius_m = radius;
        if (radius < 0.01) test.mould = {0.050, 0.035, 0.060};
        const double c = strength_pa * radius * radius, gap = 0.4 * radius;
        test.contact.bridge = {
            BridgeShape::polynomial, BridgeFormation::film, 0, 0.8 * c / gap, c, -gap, 0.25 * gap, 0, 0, 0};
        test.contact.cohesion_n = cohesion_ratio * c;
        const Outcome outcome = simulate(test);
        INFO("radius " << radius << " m, " << strength_pa << " Pa, cohesion ratio " << cohesion_ratio);
        REQUIRE_FALSE(outcome.failure);
        CHECK(std::fabs(outcome.run.energy_error.value()) < 2e-3);
      }
}

TEST_CASE("what a sticky mould has lifted is let down without being crushed, and no energy is created") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SlumpTest test = small_test(10);
    test.packing_seed = seed;
    test.mould_wall.cohesion_factor = 2;
    const Outcome outcome = simulate(test);
    INFO("packing " << seed);
    REQUIRE_FALSE(outcome.failure);
    CHECK(std::fabs(outcome.run.energy_error.value()) < 4e-3);
  }
}

TEST_CASE("grains that resist rolling strongly come to rest, and do not hum on the spot") {
  SlumpTest test = small_test(5);
  test.contact.restitution = 0.6;
  test.contact.rolling_friction = 0.9;
  const Outcome outcome = simulate(test);
  REQUIRE_FALSE(outcome.failure);
  CHECK(outcome.run.settled);
  CHECK(std::fabs(outcome.run.energy_error.value()) < 4e-3);
}

TEST_CASE("a mould that starts at full speed from soft grains creates no energy") {
  SlumpTest test = small_test(0);
  test.contact.youngs_modulus_pa = 3e5;
  test.lift_velocity_m_s = 0.9;
  const Outcome outcome = simulate(test);
  REQUIRE_FALSE(outcome.failure);
  CHECK(outcome.run.energy_error.value() < 2e-3);
}

TEST_CASE("a heap that has flowed off its table has no height below zero, and none at all where nothing is left") {
  SlumpTest test = small_test(0);
  test.contact.friction = test.table_wall.friction = 0.02;
  test.contact.rolling = RollingModel::none;
  test.table_length_m = 0.21;
  RunOptions options;
  options.rest = {1.0, 1, 1e3, 1e3};  // grains roll on over the ground for ever
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    test.packing_seed = seed;
    const Outcome outcome = simulate(test, options);
    INFO("packing " << seed);
    REQUIRE_FALSE(outcome.failure);
    CHECK(outcome.readings.find("step1.spilled_share").value() > 0.5);
    for (const char* reading : {"step1.height_mm", "step1.height_axis_mm", "step1.height_max_mm"})
      CHECK(outcome.readings.find(reading).value_or(0) >= 0);
  }
}

TEST_CASE("a heap does not differ from its own outline, and another one does by a little") {
  SlumpTest test = small_test(1);
  Outline side;
  RunOptions options;
  options.watch = [&](const Snapshot& snapshot) {
    if (snapshot.phase == "step1.rest") side = outline(snapshot.world->particles, test.grains.radius_m);
    return true;
  };
  REQUIRE_FALSE(simulate(test, options).failure);
  for (double x = -0.12; x <= 0.1201; x += 0.02) test.reading.outline_step1.push_back({x, side.at(x)});
  const auto difference = [&] { return simulate(test).readings.find("step1.profile_mm").value(); };
  const double own = difference();
  test.packing_seed = 2;
  const double other = difference();
  CHECK(own < 2.5);  // straight between points 20 mm apart
  CHECK(other > own);
  CHECK(other < 30);
}

TEST_CASE("a run that is asked to stop ends as stopped") {
  RunOptions options;
  options.watch = [](const Snapshot& snapshot) { return snapshot.time_s < 0.1; };
  const Outcome outcome = simulate(small_test(0), options);
  REQUIRE(outcome.failure);
  CHECK(outcome.failure->reason == FailureReason::stopped);
}

TEST_CASE("a step far too large ends as a classified failure") {
  RunOptions options;
  options.packing = fill_mould(small_test(5));
  options.steps.fixed_step_s = 5e-3;
  const Outcome outcome = simulate(small_test(5), options);
  REQUIRE(outcome.failure);
  CHECK_FALSE(outcome.failure->message.empty());
}

TEST_CASE("every fault of a test is named at once") {
  SlumpTest test = small_test(1);
  test.mould.top_radius_m = 0.2;
  test.contact.restitution = 0;
  test.contact.bridge.b_n_m = -1;
  test.grains.radius_m = 0.1;
  CHECK(validate(test).size() >= 4);
  CHECK(validate(small_test(1)).empty());
}

TEST_CASE("a mould that grips the grains, by friction and rolling friction 1, makes no energy") {
  SlumpTest test;
  test.mould = {0.01905, 0.0095, 0.0572};
  test.grains.radius_m = 0.0015;
  test.lift_velocity_m_s = 0.05;
  test.contact.friction = 0.3;
  test.mould_wall.friction = test.mould_wall.rolling_friction = 1;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const double r = test.grains.radius_m, c = 200.0 * static_cast<double>(seed) * r * r;
    test.contact.bridge = {
        .shape = BridgeShape::polynomial, .b_n_m = c / (0.6 * r), .c_n = c, .d_c_m = -0.6 * r, .offset_m = 0.3 * r};
    test.packing_seed = seed;
    const Outcome outcome = simulate(test);
    INFO("packing " << seed);
    REQUIRE_FALSE(outcome.failure);
    CHECK(outcome.run.settled);
    CHECK(std::fabs(outcome.run.energy_error.value()) < 4e-3);
  }
}
