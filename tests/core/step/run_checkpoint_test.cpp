#include "core/step/run_checkpoint.h"

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "core/apparatus/pellet_crush/pellet_crush.h"
#include "core/apparatus/shear_cell/shear_cell.h"
#include "core/apparatus/slump/slump_test.h"
#include "tests/core/apparatus/soft_granules.h"

namespace pastefit {
namespace {

PelletCrush pellet() {
  PelletCrush test = small_pellet(1.0);
  test.press_speedup = 500;
  test.platen_speed_m_s = 0.4;
  test.final_strain = 0.05;
  return test;
}

ShearCell cell() {
  ShearCell test = small_cell(0.5);
  test.shear_speedup = 1000;
  test.final_displacement_m = 0.002;
  return test;
}

/// Grains with bridges, and a plate that is dropped.
SlumpTest slump() {
  SlumpTest test;
  test.grains.radius_m = 0.014;
  test.lift_velocity_m_s = 0.3;
  const double r = test.grains.radius_m, c = 2000 * r * r;
  test.contact.youngs_modulus_pa = 5e6;
  test.contact.bridge = {
      BridgeShape::polynomial, BridgeFormation::film, 0, 0.8 * c / (0.8 * r), c, -0.8 * r, 0.2 * r, 0, 0, 0};
  test.drop = DropPlate{};
  return test;
}

/// Runs the test in sessions that are killed after so many pulses, each of which goes on from the state that the one
/// before left, made `early` pulses before it was killed. Returns their number.
template <class Test>
int sessions(const Test& test, RunOptions options, int pulses, int early, Outcome& outcome) {
  std::string state;
  for (int session = 1;; ++session) {
    int seen = 0;
    std::string kept;
    options.checkpoint = std::make_shared<RunCheckpoint>([&] { return seen == pulses - early; },
                                                         [&](const std::string& now) {
                                                           if (kept.empty()) kept = now;
                                                         },
                                                         state);
    options.pulse = [&](const Snapshot&) { return ++seen <= pulses; };
    outcome = simulate(test, options);
    if (!outcome.failure || outcome.failure->reason != FailureReason::stopped) return session;
    REQUIRE_FALSE(kept.empty());
    state = kept;
  }
}

void check_same(const Outcome& one, const Outcome& other) {
  REQUIRE_FALSE(one.failure);
  REQUIRE_FALSE(other.failure);
  REQUIRE_FALSE(one.readings.all().empty());
  REQUIRE(one.readings.all().size() == other.readings.all().size());
  for (const auto& [name, value] : one.readings.all()) {
    INFO(name);
    CHECK(other.readings.find(name) == value);
  }
  CHECK(one.run.steps == other.run.steps);
  CHECK(one.run.particle_steps == other.run.particle_steps);
  CHECK(one.run.simulated_s == other.run.simulated_s);
  CHECK(one.run.advised_step_s == other.run.advised_step_s);
  CHECK(one.run.energy_error == other.run.energy_error);
  CHECK(one.run.settled == other.run.settled);
  REQUIRE(one.curve.has_value() == other.curve.has_value());
  if (!one.curve) return;
  REQUIRE(one.curve->points.size() == other.curve->points.size());
  for (std::size_t k = 0; k < one.curve->points.size(); ++k) {
    CHECK(one.curve->points[k].x == other.curve->points[k].x);
    CHECK(one.curve->points[k].y == other.curve->points[k].y);
  }
}

template <class Test>
void check_resumed(const Test& test, int pulses, int early, const RunOptions& options = {}) {
  Outcome resumed;
  const int count = sessions(test, options, pulses, early, resumed);
  INFO(count << " sessions");
  CHECK(count > 3);
  check_same(simulate(test, options), resumed);
}

TEST_CASE("a pellet crush that is killed again and again, and goes on, has the bits of one that was not") {
  check_resumed(pellet(), 40, 3);
}

TEST_CASE("a run that its pulse stops leaves its state although none was due, and goes on with the same bits") {
  const PelletCrush test = pellet();
  std::string left;
  RunOptions options;
  options.checkpoint =
      std::make_shared<RunCheckpoint>([] { return false; }, [&](const std::string& now) { left = now; });
  options.pulse = [seen = 0](const Snapshot&) mutable { return ++seen < 40; };
  REQUIRE(simulate(test, options).failure);
  REQUIRE_FALSE(left.empty());
  RunOptions resumed;
  resumed.checkpoint = std::make_shared<RunCheckpoint>([] { return false; }, [](const std::string&) {}, left);
  check_same(simulate(test, {}), simulate(test, resumed));
}

TEST_CASE("a shear cell that is killed again and again, and goes on, has the bits of one that was not") {
  check_resumed(cell(), 40, 3);
}

TEST_CASE("a slump test with its drops that is killed again and again, and goes on, has the bits of one that was not") {
  check_resumed(slump(), 35, 2);
}

TEST_CASE("a heap that rests under its mould does not wait for rest once more, killed or not") {
  SlumpTest test = slump();
  test.lift_velocity_m_s = 0.03;
  std::string before, after_lift;
  RunOptions options;
  options.pulse = [&](const Snapshot& snapshot) {
    if (before == "step1.lift" && after_lift.empty() && snapshot.phase != before) after_lift = snapshot.phase;
    before = snapshot.phase;
    return true;
  };
  const Outcome whole = simulate(test, options);
  REQUIRE_FALSE(whole.failure);
  REQUIRE(whole.run.simulated_s < test.mould.height_m / test.lift_velocity_m_s);  // the mould was still around it
  CHECK(after_lift == "step2.raise");
  check_resumed(test, 60, 2);
}

TEST_CASE("a jolting table that is killed again and again, and goes on, has the bits of one that was not") {
  SlumpTest test = slump();
  test.drop->motion = TableMotion::vertical;
  test.drop->lift_height_m = 0.01;
  test.drop->drops = 4;
  check_resumed(test, 28, 2);
}

TEST_CASE("a tilted table that is killed again and again, and goes on, has the bits of one that was not") {
  SlumpTest test = slump();
  test.drop.reset();
  test.tilt = Tilt{20, 0.005};
  check_resumed(test, 28, 2);
}

TEST_CASE("a run with fixed waits that is killed again and again, and goes on, has the bits of one that was not") {
  RunOptions options;
  options.fixed_wait_s = 0.2;
  check_resumed(slump(), 28, 0, options);
}

TEST_CASE("a state is asked for without changing the run") {
  RunOptions asked;
  int looks = 0, states = 0;
  asked.checkpoint =
      std::make_shared<RunCheckpoint>([&] { return ++looks % 8 == 0; }, [&](const std::string&) { ++states; });
  const Outcome one = simulate(cell()), other = simulate(cell(), asked);
  CHECK(states > 10);
  check_same(one, other);
}

}  // namespace
}  // namespace pastefit
