#include "core/apparatus/drop_test/drop_test.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace pastefit {
namespace {

/// A dry ball of gravel on a slab of its own.
DropTest dry(double restitution, double friction = 0.1) {
  DropTest test;
  test.bulk_density_kg_m3 = 2650;
  test.grains.radius_m = 0.01;
  test.contact.youngs_modulus_pa = 5e10;
  test.contact.restitution = restitution;
  test.contact.friction = friction;
  test.contact.rolling_friction = 0;
  return test;
}

double read(const DropTest& test, const char* name) {
  REQUIRE(validate(test).empty());
  const Outcome outcome = simulate(test);
  REQUIRE_FALSE(outcome.failure);
  return outcome.readings.find(name).value();
}

double level_rise_mm(const DropTest& test) {
  return read(test, "level.rebound_height_mm");
}

TEST_CASE("a dry ball rises to the height it fell times the restitution squared, whatever its size and stiffness") {
  for (const double restitution : {0.3, 0.6, 0.8, 0.95}) {
    for (const double height : {0.1, 2.0}) {
      INFO("restitution " << restitution << ", from " << height << " m");
      DropTest test = dry(restitution);
      test.drop_height_m = height;
      CHECK(level_rise_mm(test) == Approx(1e3 * restitution * restitution * height).epsilon(0.01));
      test.grains.radius_m = 0.003;
      test.contact.youngs_modulus_pa = 1e8;
      CHECK(level_rise_mm(test) == Approx(1e3 * restitution * restitution * height).epsilon(0.01));
    }
  }
}

TEST_CASE(
    "a ball that slides throughout an oblique contact leaves with the spin and the height of Coulomb's friction") {
  const double restitution = 0.9, friction = 0.05;
  for (const double degrees : {30.0, 40.0, 60.0}) {
    INFO(degrees << " degrees");
    DropTest test = dry(restitution, friction);
    test.plate_tilt_rad = degrees * std::acos(-1) / 180;
    const double sine = std::sin(test.plate_tilt_rad), cosine = std::cos(test.plate_tilt_rad);
    REQUIRE(sine / cosine > 1.5 * 3.5 * friction * (1 + restitution));
    const double speed = impact_speed_m_s(test), push = friction * (1 + restitution) * speed * cosine;
    CHECK(read(test, "tilted.spin_rad_s") == Approx(2.5 * push / test.grains.radius_m).epsilon(0.01));
    const double upwards = restitution * speed * cosine * cosine - (speed * sine - push) * sine;
    const double rise_mm = upwards > 0 ? 1e3 * upwards * upwards / (2 * 9.81) : 0;
    CHECK(read(test, "tilted.rebound_height_mm") == Approx(rise_mm).epsilon(0.03).margin(0.1));
  }
}

TEST_CASE("a soft ball has a shorter lever, and spins less by its overlap") {
  DropTest test = dry(0.9, 0.05);
  test.plate_tilt_rad = 0.8;
  const double hard = read(test, "tilted.spin_rad_s");
  test.contact.youngs_modulus_pa = 1e9;
  const double soft = read(test, "tilted.spin_rad_s");
  CHECK(soft < 0.99 * hard);
  CHECK(soft > 0.97 * hard);
}

TEST_CASE(
    "a ball that sticks to the plate hardly tells its friction: twice as much moves its spin by less than a fiftieth") {
  DropTest test = dry(0.8, 2);
  test.plate_tilt_rad = 0.3;
  const double spin = read(test, "tilted.spin_rad_s");
  test.contact.friction = 4;
  CHECK(read(test, "tilted.spin_rad_s") == Approx(spin).epsilon(0.02));
  const double most = 10.0 / 7 * impact_speed_m_s(test) * std::sin(test.plate_tilt_rad) / test.grains.radius_m;
  CHECK(spin > 0);
  CHECK(spin < most);
}

TEST_CASE("attraction takes from the rebound, and a ball that cannot get away rises by less than its bridge is long") {
  DropTest test = dry(0.6);
  const double free_mm = level_rise_mm(test);
  Bridge& bridge = test.contact.bridge;
  bridge.shape = BridgeShape::linear;
  bridge.d_c_m = -0.2 * test.grains.radius_m;
  bridge.offset_m = 0.1 * test.grains.radius_m;
  const double mass_kg = 4.0 / 3 * std::acos(-1) * std::pow(test.grains.radius_m, 3) * test.bulk_density_kg_m3;
  const double energy_j = mass_kg * 9.81 * 1e-3 * free_mm;
  bridge.c_n = 0.2 * energy_j / (0.5 * -bridge.d_c_m);  // its work is a fifth of what the ball rises with
  const double sticky_mm = level_rise_mm(test);
  CHECK(sticky_mm < 0.95 * free_mm);
  CHECK(sticky_mm > 0.5 * free_mm);
  bridge.c_n *= 50;
  CHECK(level_rise_mm(test) < -1e3 * bridge.d_c_m);
}

TEST_CASE("nothing in a drop test is random: another seed gives the same bits") {
  DropTest test = dry(0.7);
  test.plate_tilt_rad = 0.6;
  const Outcome one = simulate(test);
  test.packing_seed = 77;
  const Outcome other = simulate(test);
  REQUIRE(one.readings.all().size() == reading_kinds(test).size());
  for (const Reading& reading : one.readings.all()) CHECK(other.readings.find(reading.name).value() == reading.value);
}

TEST_CASE("a drop costs some thousand steps, not the whole fall, and says which step it asks for") {
  const Outcome outcome = simulate(dry(0.7));
  CHECK(outcome.run.steps < 5000);
  CHECK(outcome.run.simulated_s < 0.01);
  CHECK(outcome.run.advised_step_s == Approx(outcome.run.time_step_s).epsilon(0.1));
}

TEST_CASE("a level plate alone has no tilted readings, and their rows say so") {
  const DropTest test = dry(0.7);
  CHECK(simulate(test).readings.all().size() == 1);
  for (const ReadingKind& kind : reading_kinds(test)) CHECK(kind.lack.has_value() == kind.name.starts_with("tilted."));
}

TEST_CASE("a drop test of several sizes, from nowhere, on a wall is refused") {
  DropTest test = dry(0.7);
  test.grains = {SizeDistribution::uniform, 0.01, 0, 0.008, 0.012};
  test.drop_height_m = 0;
  test.plate_tilt_rad = 1.5;
  test.contact.restitution = 2;
  CHECK(validate(test).size() == 4);
}

}  // namespace
}  // namespace pastefit
