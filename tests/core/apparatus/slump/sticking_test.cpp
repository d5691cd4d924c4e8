#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/apparatus/slump/packing.h"
#include "core/apparatus/slump/slump_test.h"

using namespace pastefit;

namespace {

/// The EN 12350-5 cone filled with coarse grains that stick where they touch, by so many of their weights, and do not
/// attract each other across gaps.
SlumpTest sticking(double pull_off_in_weights) {
  SlumpTest test;
  test.grains.radius_m = 0.012;
  test.lift_velocity_m_s = 0.2;
  test.contact.normal = NormalLaw::jkr;
  test.contact.cohesion_n = 0;
  const double r = test.grains.radius_m;
  const double weight = test.bulk_density_kg_m3 / 0.6 * 4.19 * r * r * r * 9.81;
  test.contact.surface_energy_j_m2 = pull_off_in_weights * weight / (1.5 * std::numbers::pi * r);
  return test;
}

/// The same cone filled with grains that yield and adhere, as a study starts with them.
SlumpTest yielding(double adhesion) {
  SlumpTest test;
  test.grains.radius_m = 0.01;
  test.contact.normal = NormalLaw::epa;
  test.contact.plasticity_ratio = 0.85;
  test.contact.adhesion_ratio = adhesion;
  test.contact.cohesion_n = 0;
  test.contact.friction = 0.05;
  test.contact.rolling_friction = 0.01;
  return test;
}

}  // namespace

TEST_CASE("JKR in a crowd: the stronger grains stick, the higher the heap stands") {
  constexpr std::array<double, 3> pull_offs{0, 1, 2};
  std::array<double, 3> heights{};
  for (std::size_t k = 0; k < pull_offs.size(); ++k)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SlumpTest test = sticking(pull_offs[k]);
      test.packing_seed = seed;
      const Outcome outcome = simulate(test);
      INFO("pull-off of " << pull_offs[k] << " weights, packing " << seed);
      REQUIRE_FALSE(outcome.failure);
      CHECK(outcome.run.settled);
      heights[k] += *outcome.readings.find("step1.height_mm") / 3;
    }
  INFO(heights[0] << ", " << heights[1] << ", " << heights[2] << " mm");
  CHECK(heights[1] > heights[0] + 10);
  CHECK(heights[2] > heights[1] + 10);
}

TEST_CASE("JKR in a crowd: the energy of both steps is accounted for, of a heap that slumps and of one that stands") {
  const auto error_with = [](double pull_off, double impact_resolution) {
    SlumpTest test = sticking(pull_off);
    test.drop = DropPlate{};
    RunOptions options;
    options.steps.impact_resolution = impact_resolution;
    const Outcome outcome = simulate(test, options);
    REQUIRE_FALSE(outcome.failure);
    return std::fabs(outcome.run.energy_error.value());
  };
  const double coarse = error_with(1, StepOptions{}.impact_resolution), fine = error_with(1, 40);
  INFO(coarse << " at the default step, " << fine << " at a quarter");
  CHECK(coarse < 4e-3);
  CHECK(fine < 0.3 * coarse);
  CHECK(error_with(30, StepOptions{}.impact_resolution) < 4e-3);
}

TEST_CASE(
    "DMT and SJKR in a crowd: the heap stands higher than without, and its energy is accounted for in both steps") {
  for (const NormalLaw law : {NormalLaw::dmt, NormalLaw::sjkr}) {
    SlumpTest test = sticking(0);
    test.drop = DropPlate{};
    const Outcome dry = simulate(test);
    test.contact.normal = law;
    test.contact.surface_energy_j_m2 = sticking(1).contact.surface_energy_j_m2;
    // Two grains are parted by as much: 2/3 pi^3 k^3 R*^2/E*^2 = 4 pi gamma R*.
    const double modulus = test.contact.youngs_modulus_pa / (2 * (1 - std::pow(test.contact.poissons_ratio, 2)));
    test.contact.cohesion_energy_density_pa = std::cbrt(6 * test.contact.surface_energy_j_m2 * modulus * modulus /
                                                        (std::pow(std::numbers::pi, 2) * 0.5 * test.grains.radius_m));
    INFO("law " << static_cast<int>(law) << ", k " << test.contact.cohesion_energy_density_pa);
    const Outcome outcome = simulate(test);
    REQUIRE_FALSE(dry.failure);
    REQUIRE_FALSE(outcome.failure);
    CHECK(outcome.readings.find("step1.height_mm").value() > dry.readings.find("step1.height_mm").value() + 5);
    CHECK(std::fabs(outcome.run.energy_error.value()) < 4e-3);
  }
}

TEST_CASE("JKR in a crowd: sticking grains that fill a mould under their own laws lie looser than dry ones") {
  RunOptions own;
  own.own_fill = true;
  const auto mean_fraction = [&](double pull_off) {
    constexpr int kPackings = 8;
    SlumpTest test = sticking(pull_off);
    double sum = 0;
    for (test.packing_seed = 1; test.packing_seed <= kPackings; ++test.packing_seed) {
      const auto packing = fill_mould(test, own);
      REQUIRE_FALSE(packing->failure);
      sum += packing->solid_volume_m3 / volume_m3(test.mould);
    }
    return sum / kPackings;
  };
  CHECK(mean_fraction(3) < 0.98 * mean_fraction(0));
}

TEST_CASE("elasto-plastic grains that adhere: a stiff heap stands, and where the table is smooth it spreads farther") {
  double height[2] = {}, spread[2] = {}, shift = 0;
  constexpr int kPackings = 3;
  for (int smooth = 0; smooth < 2; ++smooth)
    for (std::uint64_t seed = 1; seed <= kPackings; ++seed) {
      SlumpTest test = yielding(1.2);
      test.table_wall.friction = smooth ? 0.02 : 0.6;
      test.packing_seed = seed;
      const Outcome outcome = simulate(test);
      INFO("packing " << seed << (smooth ? ", smooth" : ""));
      REQUIRE_FALSE(outcome.failure);
      CHECK(outcome.run.settled);
      height[smooth] += *outcome.readings.find("step1.height_mm") / kPackings;
      spread[smooth] += *outcome.readings.find("step1.spread_mm") / kPackings;
      shift = std::max(shift, *outcome.readings.find("step1.lateral_shift_mm"));
    }
  INFO("heights " << height[0] << ", " << height[1] << ", spreads " << spread[0] << ", " << spread[1] << " mm");
  CHECK(height[0] > 110);
  CHECK(height[0] < 190);
  CHECK(spread[1] > spread[0] + 15);
  CHECK(shift > 0);
  CHECK(shift < 40);
}

TEST_CASE("elasto-plastic grains that adhere: the energy of both steps is accounted for") {
  const auto error_with = [](double adhesion, double impact_resolution) {
    SlumpTest test = yielding(adhesion);
    test.drop = DropPlate{};
    RunOptions options;
    options.steps.impact_resolution = impact_resolution;
    const Outcome outcome = simulate(test, options);
    REQUIRE_FALSE(outcome.failure);
    return std::fabs(outcome.run.energy_error.value());
  };
  CHECK(error_with(0.3, StepOptions{}.impact_resolution) < 4e-3);
  CHECK(error_with(1.2, StepOptions{}.impact_resolution) < 4e-3);
  CHECK(error_with(1.2, 40) < 1e-3);
}
