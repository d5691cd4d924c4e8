#include "calibrate/evaluate/cost.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "calibrate/base/machine.h"
#include "calibrate/base/text.h"
#include "calibrate/study/tests.h"

namespace pastefit {

namespace {

/// Peak memory: a settled box of 100,000 to 1,000,000 grains takes 750 to 1000 bytes for each (tests/bench/speed).
constexpr double kBytesPerGrain = 1000;

}  // namespace

Faults validate_memory(const Test& test, int at_once) {
  const int simulations = at_once > 0 ? at_once : processors();
  const double needed = simulations * (kBytesPerGrain * grains_needed(test)), free = memory_available_bytes();
  if (needed <= free) return {};
  return {{"grains",
           format("%.3g", grains_needed(test)) + " grains in " + std::to_string(simulations) +
               (simulations == 1 ? " simulation" : " simulations at a time") + " need about " +
               format("%.3g", needed / 1e9) + " GB of memory, " + format("%.3g", free / 1e9) + " GB are free",
           simulations > 1 && needed / simulations <= free ? "give fewer --threads, or take larger grains"
                                                           : "take larger grains"}};
}

Faults validate_memory(const Study& study, int at_once) {
  for (const StudyTest& test : study.tests)
    if (auto faults = validate_memory(test.lab.test, at_once); !faults.empty()) return faults;
  return {};
}

namespace {

constexpr double kParticleStepsPerSecond = 2e7;
constexpr double kFillAndRest_s = 1;
constexpr double kImpactSpeed_m_s = 1;
constexpr double kStepsPerCollision = 10;
constexpr double kSolidShare = 0.6;  // of the bulk volume: converts bulk density to the density of a grain

/// Hertzian collision time of two equal grains at `kImpactSpeed_m_s` [s].
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
