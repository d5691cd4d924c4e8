#include "tests/stability/parameter_case.h"

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include "calibrate/study/parameters.h"
#include "core/laws/table.h"
#include "core/random.h"

namespace pastefit {

namespace {

// Parameter j of corner n is at its upper end where n and column j have an odd number of bits in common. No four or
// fewer columns add up to nothing (mod 2): that makes the strength 4 (Bose & Bush 1952). Nine bits have no more than
// 23 such columns (Wagner's code of length 23 and distance 5); found by drawing.
constexpr std::array<unsigned, 23> kDesign{1,   2,  4,   8,   16,  32, 64,  128, 256, 267, 346, 499,
                                           279, 95, 447, 149, 365, 62, 121, 143, 500, 220, 178};

constexpr bool have_strength_4() {
  for (const unsigned a : kDesign)
    for (const unsigned b : kDesign)
      for (const unsigned c : kDesign) {
        if (a < b && b < c && (a ^ b ^ c) == 0) return false;
        for (const unsigned d : kDesign)
          if (a < b && b < c && c < d && (a ^ b ^ c ^ d) == 0) return false;
      }
  return true;
}
static_assert(have_strength_4());

// Beyond this the step shrinks with the viscosity, and soft grains are refused.
constexpr double kMostViscous = 1;  // [Pa s]

/// The n-th of the choices of a law.
template <class Law>
Law choice(std::uint64_t drawn) {
  return static_cast<Law>(drawn % (static_cast<std::uint64_t>(Law::last) + 1));
}

StressCase case_at(const std::vector<double>& unit, int number, const RandomStream& laws) {
  StressCase stress;
  stress.number = number;
  stress.searched = true;
  SlumpTest test = small_cone(number, 0.009);
  test.contact.normal = choice<NormalLaw>(laws.bits(0));
  test.contact.bridge.shape = choice<BridgeShape>(laws.bits(1));
  if (!go_together(test.contact.normal, test.contact.bridge.shape)) test.contact.bridge.shape = BridgeShape::none;
  test.contact.rolling = choice<RollingModel>(laws.bits(2));
  test.contact.bridge.formation = laws.bits(3) % 2 ? BridgeFormation::film : BridgeFormation::touch;
  test.contact.friction_basis = laws.bits(4) % 2 ? FrictionBasis::total : FrictionBasis::elastic;

  std::vector<double> values;
  for (const ParameterKind& kind : parameter_kinds()) {
    const Parameter parameter{.name = std::string(kind.name),
                              .free = true,
                              .lower = kind.smallest,
                              .upper = kind.name == "viscosity_pa_s" ? kMostViscous : kind.largest,
                              .scale = kind.scale};
    values.push_back(value_between(parameter, unit[values.size()]));
  }
  stress.test = std::get<SlumpTest>(with_contact_of(std::move(test), values));
  const ContactModel& contact = stress.test.contact;
  const double radius = stress.test.grains.radius_m;
  const double weight = 9.81 * stress.test.bulk_density_kg_m3 / 0.6 * 4 / 3 * std::numbers::pi * std::pow(radius, 3);
  if (contact.bridge.shape != BridgeShape::none) {
    stress.weights = contact.bridge.c_n / weight;
    stress.gap_ratio = -contact.bridge.d_c_m / radius;
  }
  return stress;
}

}  // namespace

std::vector<StressCase> parameter_cases(int first, int count, std::uint64_t seed) {
  static_assert(kParameterCorners == 1 << 9, "as many as there are bits in the columns");
  const RandomStream points(seed, "points of the parameters"), laws(seed, "laws");
  std::vector<StressCase> cases;
  for (int number = first; number < first + count; ++number) {
    std::vector<double> unit;
    for (std::size_t j = 0; j < parameter_kinds().size(); ++j) {
      const auto place = static_cast<std::uint64_t>(number) * kDesign.size() + j;
      const bool upper = std::popcount(static_cast<unsigned>(number) & kDesign.at(j)) % 2 == 1;
      unit.push_back(number < kParameterCorners ? upper : points.uniform(place));
    }
    cases.push_back(case_at(unit, number, RandomStream(laws.bits(static_cast<std::uint64_t>(number)), "law")));
  }
  return cases;
}

}  // namespace pastefit
