#include "calibrate/laboratory/yield_stress.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

namespace pastefit {

// Numbers evaluated independently of this program from the formulas of Schowalter & Christensen 1998.
TEST_CASE("the height that a fluid keeps of the flow table's mould is that of the published formula") {
  const Mould en12350_5{0.100, 0.065, 0.200};
  const std::vector<std::pair<double, double>> kept_mm{
      {100, 45.3}, {200, 75.8}, {300, 100.5}, {500, 138.4}, {800, 175.6}};
  for (const auto& [stress_pa, height_mm] : kept_mm) {
    CHECK(*kept_height_m(en12350_5, 2000, stress_pa) * 1e3 == Approx(height_mm).margin(0.06));
    CHECK(*yield_stress_of_height_pa(en12350_5, 2000, height_mm / 1e3) == Approx(stress_pa).epsilon(2e-3));
  }
}

TEST_CASE("a fluid stands as its mould from the stress on that the weight of the whole makes at the base") {
  const auto stands = [](const Mould& mould, double share) {
    return *kept_height_m(mould, 2000, share * 2000 * 9.81 * mould.height_m) == Approx(mould.height_m).epsilon(1e-9);
  };
  const Mould abrams{0.100, 0.050, 0.300}, en12350_5{0.100, 0.065, 0.200};
  CHECK(stands(abrams, 0.2918));
  CHECK_FALSE(stands(abrams, 0.285));
  CHECK(stands(en12350_5, 0.3455));
  CHECK_FALSE(stands(en12350_5, 0.338));
}

TEST_CASE("a frustum that hardly widens keeps what a cylinder keeps") {
  const Mould cylinder{0.05, 0.05, 0.1}, nearly{0.05, 0.04995, 0.1};
  for (const double stress_pa : {50.0, 200.0, 600.0})
    CHECK(*kept_height_m(nearly, 1800, stress_pa) == Approx(*kept_height_m(cylinder, 1800, stress_pa)).epsilon(2e-3));
}

TEST_CASE("a cake of the spread that a yield stress makes holds the volume of its profile") {
  // h(r) = sqrt(2 tau (R - r)/(rho g)), integrated by the midpoint rule.
  const double volume = 0.0055, density = 2350, radius = 0.3;
  const double stress = yield_stress_of_spread_pa(volume, density, radius);
  const int rings = 100000;
  double sum = 0;
  for (int k = 0; k < rings; ++k) {
    const double r = (k + 0.5) * radius / rings;
    sum += 2 * 3.14159265358979324 * r * std::sqrt(2 * stress * (radius - r) / (density * 9.81)) * radius / rings;
  }
  CHECK(sum == Approx(volume).epsilon(1e-6));
}

TEST_CASE("a heap as high as its mould, or of a mould that widens upwards, has no yield stress by its height") {
  const Mould abrams{0.100, 0.050, 0.300}, upside_down{0.050, 0.100, 0.300};
  CHECK_FALSE(yield_stress_of_height_pa(abrams, 2000, 0.3));
  CHECK_FALSE(yield_stress_of_height_pa(abrams, 2000, 0));
  CHECK_FALSE(yield_stress_of_height_pa(upside_down, 2000, 0.1));
}

}  // namespace pastefit
