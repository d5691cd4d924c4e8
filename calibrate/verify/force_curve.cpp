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

double resting_overlap_m(const ContactModel& contact, const GrainPair& pair, double load) {
  const double force = load + cohesion_n(contact, pair),
               passage = kPassage * pair.reference_radius_m * pair.size_scale();
  const double deep = force > 0 ? std::pow(force / repulsion_n(contact, pair, 1.0), 2.0 / 3.0) : 0;
  if (contact.bridge.shape == BridgeShape::none || deep >= passage) return deep;
  double least = 0, most = passage;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (least + most);
    const bool pressed = repulsion_n(contact, pair, middle) > load + attraction_n(contact, pair, middle);
    (pressed ? most : least) = middle;
  }
  return most;
}

BridgeGaps bridge_gaps(const ContactModel& contact, const GrainPair& pair) {
  const Bridge& bridge = contact.bridge;
  if (bridge.shape == BridgeShape::none) return {};
  const double s = pair.size_scale();
  const double shells = bridge.formation == BridgeFormation::film ? 2 * bridge.offset_m : 0.0;
  return {s * shells, s * rupture_gap(bridge, pair.reference_radius_m)};
}

double bridge_work_j(const ContactModel& contact, const GrainPair& pair, double from, double to) {
  constexpr int kIntervals = 2000;
  const double h = (to - from) / kIntervals;
  double sum = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double weight = i == 0 || i == kIntervals ? 1 : (i % 2 == 1 ? 4 : 2);
    sum += weight * attraction_n(contact, pair, -std::min(from + i * h, to));
  }
  return sum * h / 3;
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
