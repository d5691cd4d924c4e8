#include "tests/stability/attraction_case.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <variant>

#include "calibrate/study/parameters.h"
#include "core/random.h"

namespace pastefit {

namespace {

constexpr std::array kRadii{0.009, 0.0045, 0.003};     // [m]
constexpr std::array kStrengths{4e4, 9000.0, 2000.0};  // c/R^2 [Pa]
/// What is varied: the cohesion over the attraction at touch, and the shares of the mould and of the table.
struct Shares {
  double cohesion, mould, table;
};
constexpr std::array<Shares, 18> kShares{{{0, 0, 0},
                                          {0.1, 0, 0},
                                          {0.3, 0, 0},
                                          {0.5, 0, 0},
                                          {0.8, 0, 0},
                                          {1, 0, 0},
                                          {1.5, 0, 0},
                                          {3, 0, 0},
                                          {10, 0, 0},
                                          {1, 0.5, 0},
                                          {1, 1, 0},
                                          {1, 1.5, 0},
                                          {1, 2, 0},
                                          {1, 0, 1},
                                          {1, 0, 2},
                                          {1, 2, 2},
                                          {0, 2, 2},
                                          {0.3, 1, 1}}};
constexpr auto kGrid = static_cast<int>(kRadii.size() * kStrengths.size() * kShares.size());

/// What a study usually searches.
struct Range {
  std::string_view name;
  double lower, upper;
};
constexpr std::array<Range, 7> kDrawn{{{"rupture_force_ratio", 0, 0.5},
                                       {"curvature", -0.5, 1},
                                       {"rupture_gap_ratio", 0.15, 1},
                                       {"formation_ratio", 0, 1},
                                       {"friction", 0.01, 0.8},
                                       {"rolling_friction", 0, 1},
                                       {"table_friction", 0.1, 1}}};

/// All parameters: the default ones, those drawn, and those of the grid.
std::vector<double> values_of(double strength, const Shares& shares, const RandomStream& drawn) {
  std::vector<double> values = default_values();
  const auto set = [&](std::string_view name, double value) {
    std::size_t at = 0;
    while (parameter_kinds()[at].name != name) ++at;
    values[at] = value;
  };
  for (std::size_t i = 0; i < kDrawn.size(); ++i)
    set(kDrawn[i].name, std::lerp(kDrawn[i].lower, kDrawn[i].upper, drawn.uniform(i)));
  set("strength_pa", strength);
  set("cohesion_ratio", shares.cohesion);
  set("mould_cohesion_factor", shares.mould);
  set("table_cohesion_factor", shares.table);
  return values;
}

StressCase case_of(int number, const RandomStream& drawn) {
  const auto at = static_cast<std::size_t>(number % kGrid);
  const Shares& shares = kShares[at % kShares.size()];
  const double strength = kStrengths[at / kShares.size() % kStrengths.size()];
  const double radius = kRadii[at / kShares.size() / kStrengths.size()];
  StressCase stress;
  stress.number = number;
  stress.searched = true;
  stress.keeps_energy = true;
  SlumpTest test = small_cone(number, radius);
  test.contact.bridge.shape = BridgeShape::polynomial;
  test.contact.bridge.formation = drawn.bits(20) % 2 ? BridgeFormation::film : BridgeFormation::touch;
  test.contact.friction_basis = drawn.bits(21) % 2 ? FrictionBasis::total : FrictionBasis::elastic;
  stress.test = std::get<SlumpTest>(with_contact_of(std::move(test), values_of(strength, shares, drawn)));
  const Bridge& bridge = stress.test.contact.bridge;
  const double weight = 9.81 * stress.test.bulk_density_kg_m3 / 0.6 * 4 / 3 * std::numbers::pi * std::pow(radius, 3);
  stress.weights = bridge.c_n / weight;
  stress.gap_ratio = -bridge.d_c_m / radius;
  return stress;
}

}  // namespace

int attraction_grid() {
  return kGrid;
}

std::vector<StressCase> attraction_cases(int first, int count, std::uint64_t seed) {
  const RandomStream points(seed, "points of the attraction");
  std::vector<StressCase> cases;
  for (int number = first; number < first + count; ++number)
    cases.push_back(case_of(number, RandomStream(points.bits(static_cast<std::uint64_t>(number)), "case")));
  return cases;
}

}  // namespace pastefit
