#include "core/apparatus/slump/plate_drop.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>

#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"
#include "core/world/world.h"

using namespace pastefit;

namespace {

/// A weakly sticky heap of coarse grains on a plate that drops so often: a test of seconds.
SlumpTest dropped(TableMotion motion, int drops, std::uint64_t seed = 1) {
  SlumpTest test;
  test.grains.radius_m = 0.012;
  test.lift_velocity_m_s = 0.2;
  test.packing_seed = seed;
  const double r = test.grains.radius_m, c = 1000 * r * r;
  test.contact.bridge = {
      BridgeShape::polynomial, BridgeFormation::film, 0, 0.8 * c / (0.8 * r), c, -0.8 * r, 0.2 * r, 0, 0, 0};
  test.drop = DropPlate{};
  test.drop->motion = motion;
  test.drop->drops = drops;
  test.drop->period_s = 1;
  if (motion == TableMotion::vertical) test.drop->lift_height_m = 0.0127;
  return test;
}

Outcome outcome_of(const SlumpTest& test, RunOptions options = {}) {
  Outcome outcome = simulate(test, options);
  REQUIRE_FALSE(outcome.failure);
  return outcome;
}

double reading(const Outcome& outcome, const char* name) {
  return outcome.readings.find(name).value();
}

constexpr TableMotion kMotions[] = {TableMotion::hinged, TableMotion::vertical};

}  // namespace

TEST_CASE("several drops leave the readings of the first as one drop leaves them, bit for bit") {
  for (const TableMotion motion : kMotions) {
    const Outcome once = outcome_of(dropped(motion, 1)), often = outcome_of(dropped(motion, 4));
    CHECK_FALSE(once.curve);
    CHECK(once.readings.all().size() + 3 == often.readings.all().size());
    for (const Reading& one : once.readings.all()) {
      INFO(one.name);
      CHECK(often.readings.find(one.name) == one.value);
    }
    const auto names = reading_names(dropped(motion, 4));
    REQUIRE(names.size() == often.readings.all().size());
    for (std::size_t k = 0; k < names.size(); ++k) CHECK(names[k] == often.readings.all()[k].name);
  }
}

TEST_CASE("more drops make a wider and lower heap, hinged and upright, on each of four packings") {
  for (const TableMotion motion : kMotions)
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      INFO("packing " << seed << ", " << (motion == TableMotion::hinged ? "hinged" : "upright"));
      const Outcome few = outcome_of(dropped(motion, 3, seed)), many = outcome_of(dropped(motion, 12, seed));
      // The first drop alone may move a heap by less than its width is read to.
      CHECK(reading(few, "step1.spread_mm") < reading(few, "after_drops.spread_mm"));
      CHECK(reading(few, "step2.spread_mm") < reading(few, "after_drops.spread_mm"));
      CHECK(reading(few, "after_drops.spread_mm") < reading(many, "after_drops.spread_mm"));
      CHECK(reading(few, "after_drops.height_mm") > reading(many, "after_drops.height_mm"));
      REQUIRE(many.curve);
      REQUIRE(many.curve->points.size() == 13);
      CHECK(many.curve->points.front().y == reading(many, "step1.spread_mm"));
      CHECK(many.curve->points.back().x == 12);
      CHECK(many.curve->points.back().y == reading(many, "after_drops.spread_mm"));
    }
}

TEST_CASE("the energy of twelve drops is accounted for to the second order of the step, hinged and upright") {
  for (const TableMotion motion : kMotions) {
    const SlumpTest test = dropped(motion, 12);
    const auto error_with = [&](double impact_resolution) {
      RunOptions options;
      options.steps.impact_resolution = impact_resolution;
      options.packing = fill_mould(test);
      return std::fabs(outcome_of(test, options).run.energy_error.value());
    };
    const double coarse = error_with(StepOptions{}.impact_resolution), fine = error_with(40);
    INFO(coarse << " at the default step, " << fine << " at a quarter");
    CHECK(fine < 2e-4);
    CHECK(coarse < 16 * 2e-4);
  }
}

TEST_CASE(
    "a heavy table that falls upright reaches its seat after sqrt(2 h/g), a light one sooner, pressed by its heap") {
  const auto fall_s = [](double mass_kg) {
    SlumpTest test = dropped(TableMotion::vertical, 1);
    test.drop->mass_kg = mass_kg;
    std::map<std::string, double> begun;
    RunOptions options;
    options.watch_interval_s = 1e-5;
    options.watch = [&](const Snapshot& snapshot) {
      begun.emplace(snapshot.phase, snapshot.time_s);
      return true;
    };
    outcome_of(test, options);
    return begun.at("step2.rest") - begun.at("step2.drop");
  };
  // The heap of 9.7 kg presses until its overlaps are relieved.
  const double free_fall = std::sqrt(2 * 0.0127 / kGravity), light = fall_s(2), heavy = fall_s(500);
  CHECK(heavy == Approx(free_fall).epsilon(0.01));
  CHECK(light < heavy);
  CHECK(light > 0.7 * free_fall);
}

TEST_CASE("an empty plate falls as long as it is said to") {
  DropPlate plate;
  // m L^2/3 w' = m g L/2 cos(a), with a small angle: L asin(h/L) = 1.5 g t^2/2.
  CHECK(fall_time_s(plate) == Approx(std::sqrt(2 * 0.04 / (1.5 * kGravity))).epsilon(1e-3));
  plate.motion = TableMotion::vertical;
  CHECK(fall_time_s(plate) == std::sqrt(2 * 0.04 / kGravity));
}

TEST_CASE("between two drops a heap is simulated no longer than the rhythm of the test, and no longer than it moves") {
  for (const TableMotion motion : kMotions) {
    SlumpTest test = dropped(motion, 1);
    const double once = outcome_of(test).run.simulated_s;
    test.drop->drops = 11;
    const double moving = moving_time_s(*test.drop);
    const auto each = [&](double period_s) {
      test.drop->period_s = period_s;
      return (outcome_of(test).run.simulated_s - once) / 10;
    };
    const double slow = each(10), quick = each(moving + 0.05);
    INFO(slow << " s and " << quick << " s a drop");
    CHECK(slow < moving + 0.6);
    // Each wait may be a window of 25 ms longer, and the last heap comes to rest.
    CHECK(quick < moving + 0.05 + 0.025 + 0.05);
    CHECK(quick < slow);
  }
}

TEST_CASE("a round table has no corners, and the plate of the same length has") {
  const SlumpTest round = dropped(TableMotion::vertical, 1), square = dropped(TableMotion::hinged, 1);
  const double near_corner = 0.45 * round.drop->length_m;
  const Vec3 above{near_corner, near_corner, 0.001};
  CHECK(nearest(table_on_seat(square), above).distance == Approx(0.001));
  const double beyond = std::hypot(std::sqrt(2.0) * near_corner - 0.5 * round.drop->length_m, 0.001);
  CHECK(nearest(table_on_seat(round), above).distance == Approx(beyond));
  const Nearest inside = nearest(table_on_seat(round), {0.1, -0.2, 0.003});
  CHECK(inside.distance == Approx(0.003));
  CHECK(inside.direction.z == Approx(-1));
}

TEST_CASE("too many drops, none, and a rhythm that the plate cannot keep are faults of their places") {
  const auto places = [](const SlumpTest& test) {
    std::string out;
    for (const Fault& fault : validate(test)) out += fault.where + " ";
    return out;
  };
  CHECK(places(dropped(TableMotion::vertical, 100)).empty());
  CHECK(places(dropped(TableMotion::hinged, 0)) == "drop.drops ");
  CHECK(places(dropped(TableMotion::hinged, 101)) == "drop.drops ");
  SlumpTest hasty = dropped(TableMotion::hinged, 15);
  hasty.drop->period_s = 0.5;
  CHECK(places(hasty) == "drop.period_s ");
  hasty.drop->drops = 1;  // then nothing comes after
  CHECK(places(hasty).empty());
}

TEST_CASE("what a table does not do is not a reading of it, and says why") {
  const auto lack_of = [](const SlumpTest& test, const char* name) {
    const auto kinds = reading_kinds(test);
    return find_kind(kinds, name)->lack.has_value();
  };
  SlumpTest none = dropped(TableMotion::hinged, 1);
  none.drop.reset();
  for (const char* name : {"step2.spread_mm", "after_drops.spread_mm", "after_drops.height_mm"}) {
    CHECK(lack_of(none, name));
    CHECK_FALSE(lack_of(dropped(TableMotion::hinged, 15), name));
  }
  CHECK(lack_of(dropped(TableMotion::hinged, 1), "after_drops.spread_mm"));
  CHECK(lack_of(dropped(TableMotion::vertical, 15), "step2.plateau_sag_mm"));
  CHECK_FALSE(lack_of(dropped(TableMotion::hinged, 15), "step2.plateau_sag_mm"));
}
