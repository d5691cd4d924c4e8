#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibrate/base/text.h"
#include "calibrate/laboratory/names.h"
#include "calibrate/report/page_content.h"
#include "calibrate/study/parameters.h"
#include "core/laws/table.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

using nlohmann::ordered_json;

constexpr int kPoints = 60;  // on either side of touch
constexpr double um = 1e6, mn = 1e3;

/// Force on two approaching reference grains at rest [N], repulsion positive: law of the overlap minus the constant
/// cohesion in overlap, attraction across a gap.
double force_at(const ContactModel& contact, const PairConstants& pair, double radius_m, double overlap_m) {
  if (overlap_m <= 0) return -bridge_force(contact.bridge, radius_m, overlap_m);
  const double root = std::sqrt(radius_m / 2);
  return with_law(NormalLaws{}, acting(contact.normal, pair),
                  [&](auto law) { return law.at(pair, root, overlap_m, 0.0).force; }) -
         pair.cohesion;
}

/// From beyond rupture to the overlap at which repulsion balances attraction.
ordered_json points_of(const ContactModel& contact, double radius_m, double gap_m, double overlap_m) {
  const PairConstants pair = grain_pair(contact, radius_m);
  const double rupture = rupture_gap(contact.bridge, radius_m);
  auto out = ordered_json::array();
  const auto add = [&](double overlap, double force) { out.push_back({rounded(um * overlap), rounded(mn * force)}); };
  if (gap_m > rupture) {
    add(-gap_m, 0);
    add(-rupture, 0);
  }
  for (int k = kPoints; k >= 0 && rupture > 0; --k) {
    const double overlap = -rupture * k / kPoints;
    add(overlap, force_at(contact, pair, radius_m, overlap));
  }
  for (int k = 1; k <= kPoints; ++k) {
    // Denser near touch, where the slope is largest.
    const double share = static_cast<double>(k) / kPoints, overlap = overlap_m * share * share;
    add(overlap, force_at(contact, pair, radius_m, overlap));
  }
  return out;
}

/// Overlap at which the repulsion is 1.5 times the attraction, or 20 weights of a grain without attraction.
double deepest(const Card& card, const ContactModel& contact) {
  const double radius = card.material.grains.radius_m;
  const PairConstants pair = grain_pair(contact, radius);
  const double density = card.material.grain_density_kg_m3.value_or(card.material.bulk_density_kg_m3);
  const double weight = kGravity * density * 4.19 * std::pow(radius, 3);
  const double load = pair.cohesion > 0 ? 1.5 * pair.cohesion : 20 * weight;
  return std::pow(load / (pair.hertz * std::sqrt(radius / 2)), 2.0 / 3);
}

}  // namespace

ordered_json law_curves(const Card& card, const std::optional<Inference>& inference) {
  const double radius = card.material.grains.radius_m;
  const ContactModel& fitted = card.material.contact;
  const auto contact_of = [&](const std::vector<double>& values, BridgeShape shape) {
    Test test = card.tests.front().test;
    specimen_of(test).grains = card.material.grains;
    specimen_of(test).contact.bridge.shape = shape;
    return specimen_of(with_contact_of(std::move(test), values)).contact;
  };
  struct LawCurve {
    std::string name, role;
    ContactModel contact;
  };
  std::vector<LawCurve> curves;
  const Study study = study_of(card);
  for (std::size_t i = 1; inference && i < inference->family.size(); ++i) {
    const UnitPoint& point = inference->family[i].point;
    curves.push_back(
        {"equivalent material " + std::to_string(i), "equivalent",
         contact_of(values_at(study, {point.data(), static_cast<std::size_t>(point.size())}), fitted.bridge.shape)});
  }
  if (fitted.bridge.shape != BridgeShape::none)
    for (const auto& shape : bridge_shapes)
      if (shape.value != BridgeShape::none && shape.value != fitted.bridge.shape)
        curves.push_back({std::string(shape.name), "other", contact_of(values_of(card.material), shape.value)});
  curves.push_back({"fitted, " + word_of(fitted.bridge.shape, bridge_shapes), "fitted", fitted});

  double gap = 0;
  for (const LawCurve& curve : curves) gap = std::max(gap, rupture_gap(curve.contact.bridge, radius));
  auto out = ordered_json::array();
  for (const LawCurve& curve : curves)
    out.push_back({{"name", curve.name},
                   {"role", curve.role},
                   {"points", points_of(curve.contact, radius, 1.05 * gap, deepest(card, fitted))}});
  return out;
}

}  // namespace pastefit
