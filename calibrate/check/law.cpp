#include "calibrate/check/law.h"

#include <limits>

#include "calibrate/base/text.h"
#include "calibrate/verify/force_curve.h"
#include "core/apparatus/impact/impact.h"

namespace pastefit {

Outcome simulate_impact(const Impact& test) {
  return simulate(test);
}

std::vector<CheckedReading> check_law(const Material& material, const CheckEngine& engine) {
  const double radius = material.grains.radius_m;
  const GrainPair pair{radius, radius, radius};
  const double reach = bridge_gaps(material.contact, pair).rupture_m;
  const double at_touch = attraction_n(material.contact, pair, 0);
  if (!(reach > 0) || !(at_touch > 0)) return {};

  constexpr int kSteps = 20'000;
  Impact pull;
  pull.contact = material.contact;
  pull.density_kg_m3 = material.bulk_density_kg_m3;
  pull.reference_radius_m = radius;
  pull.grains.resize(2);
  for (auto& grain : pull.grains) {
    grain.radius_m = radius;
    grain.held = true;
  }
  const double start = -1e-3 * radius;  // in overlap, so that a bridge forms whatever its rule
  pull.duration_s = 1;
  pull.grains[1].centre_m = {2 * radius + start, 0, 0};
  pull.grains[1].velocity_m_s = {1.05 * reach - start, 0, 0};
  pull.step = ImpactStep::fixed;
  pull.step_s = pull.duration_s / kSteps;
  const std::vector<double> shares{0.02, 0.25, 0.5, 0.75, 0.98, 1.02};
  for (const double share : shares) pull.pull_gaps_m.push_back(share * reach);

  const auto outcome = engine.meet(pull);
  std::vector<CheckedReading> readings;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const auto name = "pull" + std::to_string(i) + "_n";
    const auto got = outcome.readings.find(name);
    readings.push_back({format("law.attraction_n at %.2f of the reach", shares[i]),
                        attraction_n(material.contact, pair, -pull.pull_gaps_m[i]),
                        got && !outcome.failure ? *got : std::numeric_limits<double>::infinity(), 1e-6 * at_touch, 1,
                        1});
  }
  return readings;
}

}  // namespace pastefit
