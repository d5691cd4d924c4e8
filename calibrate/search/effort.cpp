#include "calibrate/search/effort.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

constexpr double kParticleStepsPerSecond = 2e7;
constexpr double kFillAndRest_s = 1;
constexpr double kImpactSpeed_m_s = 1;
constexpr double kStepsPerCollision = 10;
constexpr double kSolidShare = 0.6;  // of the bulk: what grains heavier than it fill

/// Of two equal grains that meet at `kImpactSpeed_m_s`, by Hertz [s].
double collision_s(const Specimen& specimen) {
  const double radius = specimen.grains.radius_m, nu = specimen.contact.poissons_ratio;
  const double mass =
      specimen.bulk_density_kg_m3 / kSolidShare * 4 / 3 * std::numbers::pi * std::pow(radius, 3) / 2;  // reduced
  const double stiffness = specimen.contact.youngs_modulus_pa / (2 * (1 - nu * nu));
  return 2.87 * std::pow(mass * mass / (radius / 2 * stiffness * stiffness * kImpactSpeed_m_s), 0.2);
}

}  // namespace

double least_steps(const Test& test, std::optional<double> fixed_step_s) {
  const double step_s = fixed_step_s.value_or(collision_s(specimen_of(test)) / kStepsPerCollision);
  return (moved_time_s(test) + kFillAndRest_s) / step_s;
}

double least_effort_s(const Test& test, std::optional<double> fixed_step_s) {
  return grains_needed(test) * least_steps(test, fixed_step_s) / kParticleStepsPerSecond;
}

double least_effort_s(const Study& study) {
  const auto fitted = tests_of(study, false);
  double seconds = 0;
  for (const std::size_t test : fitted) seconds += least_effort_s(study.tests[test].lab.test);
  return seconds * study.search.budget_simulations / static_cast<double>(std::max<std::size_t>(1, fitted.size()));
}

}  // namespace pastefit
