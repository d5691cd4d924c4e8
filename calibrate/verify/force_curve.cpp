#include "calibrate/verify/force_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/laws/constants.h"

namespace pastefit {

double closed_bridge_n(const Bridge& bridge, double radius, double overlap) {
  const double c = attraction_at_touch(bridge, radius), reach = rupture_gap(bridge, radius);
  switch (bridge.shape) {
    case BridgeShape::none:
      return 0;
    case BridgeShape::polynomial:
      return (bridge.a_n_m2 * overlap + bridge.b_n_m) * overlap + c;
    case BridgeShape::linear:
      return c * (1 + overlap / reach);
    case BridgeShape::exponential:
      return c * std::exp(3 * overlap / reach);
    case BridgeShape::capillary: {
      const double gap = -overlap * std::sqrt(radius / bridge.liquid_volume_m3);
      return c / (1 + 1.05 * gap + 2.5 * gap * gap);
    }
  }
  throw std::logic_error("force_curve: a shape of bridge without a closed form");
}

double cohesion_n(const ContactModel& contact, const GrainPair& pair) {
  const double s = pair.size_scale();
  return s * s * contact.cohesion_n.value_or(attraction_at_touch(contact.bridge, pair.reference_radius_m));
}

double touch_excess_n(const ContactModel& contact, const GrainPair& pair) {
  if (contact.bridge.shape == BridgeShape::none) return 0;
  const double s = pair.size_scale();
  return s * s * attraction_at_touch(contact.bridge, pair.reference_radius_m) - cohesion_n(contact, pair);
}

double attraction_n(const ContactModel& contact, const GrainPair& pair, double overlap) {
  const double s = pair.size_scale(), radius = pair.reference_radius_m;
  if (overlap > 0) {
    const double left = std::max(1 - overlap / (kPassage * radius * s), 0.0);
    return cohesion_n(contact, pair) + left * touch_excess_n(contact, pair);
  }
  if (-overlap > s * rupture_gap(contact.bridge, radius)) return 0;
  return s * s * closed_bridge_n(contact.bridge, radius, overlap / s);
}

double repulsion_n(const ContactModel& contact, const GrainPair& pair, double overlap) {
  if (overlap <= 0) return 0;
  const double nu = contact.poissons_ratio;
  const double modulus = contact.youngs_modulus_pa / (2 * (1 - nu * nu));
  return 4.0 / 3.0 * modulus * std::sqrt(pair.effective_radius_m()) * std::pow(overlap, 1.5);
}

BridgeGaps bridge_gaps(const ContactModel& contact, const GrainPair& pair) {
  const Bridge& bridge = contact.bridge;
  if (bridge.shape == BridgeShape::none) return {};
  const double s = pair.size_scale();
  const double shells = bridge.formation == BridgeFormation::film ? 2 * bridge.offset_m : 0.0;
  return {s * shells, s * rupture_gap(bridge, pair.reference_radius_m)};
}

std::vector<ForcePoint> force_table(const ContactModel& contact, const GrainPair& pair, double deepest, int points) {
  const double reach = bridge_gaps(contact, pair).rupture_m;
  const double h = (reach + deepest) / (points - 1);
  const int outside = reach > 0 ? std::max(1, static_cast<int>(std::floor(reach / h))) : 0;
  const double step = reach > 0 ? reach / outside : h;
  std::vector<ForcePoint> table;
  for (int i = 0; i < points; ++i) {
    const double overlap = i == 0 ? -reach : (i - outside) * step;
    table.push_back({overlap, attraction_n(contact, pair, overlap), repulsion_n(contact, pair, overlap)});
  }
  return table;
}

}  // namespace pastefit
