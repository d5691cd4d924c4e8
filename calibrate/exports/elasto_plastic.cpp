#include "calibrate/exports/elasto_plastic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "calibrate/base/text.h"
#include "calibrate/exports/lammps_deck.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/constants.h"
#include "core/laws/table.h"
#include "core/world/world.h"

namespace pastefit {

double overlap_exponent(NormalLaw normal) {
  return normal == NormalLaw::luding ? 1 : 1.5;
}

bool yields(NormalLaw normal) {
  return with_law(NormalLaws{}, normal, [](auto law) { return law.yields; });
}

std::vector<Leg> two_grain_legs(const ContactModel& contact, double radius) {
  if (!yields(contact.normal)) {
    const auto [nearest, farthest] = two_grain_distances(contact, radius);
    const double spacing = (farthest - nearest) / 240;
    return {{"apart", nearest, farthest + spacing, 241}, {"back", farthest, nearest - spacing, 241}};
  }
  // Overlaps over the radius, not multiples of the spacing: at zero overlap, rounding would decide on contact.
  constexpr std::array turns{-0.0095, 0.0505, 0.0305, 0.0605, 0.0055, 0.0455, 0.0805, -0.0055, 0.0205, -0.0095};
  std::vector<Leg> legs;
  for (std::size_t i = 1; i < turns.size(); ++i)
    legs.push_back({"path", (2 - turns[i - 1]) * radius, (2 - turns[i]) * radius,
                    static_cast<int>(std::lround(std::fabs(turns[i] - turns[i - 1]) / 0.001))});
  return legs;
}

double matched_overlap_ratio(const ExportScene& scene) {
  const double radius = scene.radius_m();
  if (!scene.slump()) return 0.1;
  const double pressure = 0.5 * specimen_of(scene.test).bulk_density_kg_m3 * kGravity * scene.slump()->mould.height_m;
  const PairConstants pair = grain_pair(scene.contact(), radius);
  const double overlap = with_law(NormalLaws{}, scene.contact().normal, [&](auto law) {
    return law.overlap_under(pair, 0.5 * radius, 4 * radius * radius * pressure);
  });
  return overlap / (0.5 * radius);
}

double eepa_surface_energy(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const double effective = 0.5 * scene.radius_m(), m = overlap_exponent(contact.normal);
  const double k1 = grain_pair(contact, scene.radius_m()).hertz * std::pow(effective, 2 - m);
  const double plastic_power =
      contact.plasticity_ratio * std::pow(matched_overlap_ratio(scene) * effective, m);  // p^m = l d^m
  const double kc = contact.adhesion_ratio * k1, k2 = k1 / (1 - contact.plasticity_ratio);
  const double pull_off = kc * k2 / (kc + k2) * plastic_power;
  // Intersection circle of spheres with overlap p: a^2 = 2 R* p for p << R.
  const double patch = std::sqrt(2 * effective * std::pow(plastic_power, 1 / m));
  return patch > 0 ? pull_off / (1.5 * std::numbers::pi * patch) : 0;
}

namespace {

constexpr double kStepsPerCollision = 25;  // with the stiffer spring
constexpr double kLowestRestitution = 0.0501;

bool is_linear(const ContactModel& contact) {
  return contact.normal == NormalLaw::luding;
}

/// LIGGGHTS' tangential and rolling springs vary with the root of the overlap, like those of `epa`. Those of `luding`
/// are constant; they are matched at this share of the matched overlap. At the full overlap they would be too soft for
/// sliding grains: heaps were 102 mm high instead of 170 mm, and 164 mm with a ninth.
constexpr double kSpringOverlapShare = 1.0 / 9;

/// Values for the grains and each wall from the pair constants.
std::string of_pairs(const ExportScene& scene, const auto& of_pair) {
  std::vector<double> values{of_pair(grain_pair(scene.contact(), scene.radius_m()))};
  for (const auto& [name, wall] : scene.walls())
    values.push_back(of_pair(wall_pair(scene.contact(), wall, scene.radius_m())));
  return pairs_of(values);
}

}  // namespace

Edinburgh::Edinburgh(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const PairConstants pair = grain_pair(contact, scene.radius_m());
  overlap_ratio = matched_overlap_ratio(scene);
  modulus_share = 2.0 / 3 * (is_linear(contact) ? 1 : std::sqrt(overlap_ratio));
  stiffening = pair.stiffening;
  damping_share_ = std::sqrt(5.0 / 6 * overlap_exponent(contact.normal));
  const double modulus = 0.75 * pair.hertz * modulus_share;  // E'*
  const auto mass = [&](double radius) {
    return 2.0 / 3 * std::numbers::pi * std::pow(radius, 3) * scene.grain_density_kg_m3;  // m* of equal grains
  };
  const double smallest = std::min(std::ranges::min(scene.sizes.radii_m), scene.grains().smallest_m);
  const double collision = std::numbers::pi * std::sqrt(mass(smallest) / (stiffening * modulus * smallest));
  time_step_s = std::min(deck_time_step_s(scene), collision / kStepsPerCollision);
  const double damping = 2 * damping_share_ * damping_ratio(contact.restitution) *
                         std::sqrt(mass(scene.radius_m()) * modulus * scene.radius_m());
  rolling_damping = damping > 0 ? 0.3 / damping : 0;
}

double Edinburgh::restitution(double card) const {
  const double beta = damping_share_ * damping_ratio(card);
  if (beta >= 1) return kLowestRestitution;
  return std::max(std::exp(-std::numbers::pi * beta / std::sqrt(1 - beta * beta)), kLowestRestitution);
}

std::string edinburgh_models(const ContactModel& contact) {
  // Net force: limit mu |F|, rolling spring of the loading stiffness.
  const bool net = contact.friction_basis == FrictionBasis::net;
  std::string out = std::string("model edinburgh tangential ") + (net ? "history" : "tan_luding");
  if (contact.rolling != RollingModel::none && contact.rolling_friction > 0)
    out += std::string(" rolling_friction ") + (net ? "epsd" : "luding");
  return out;
}

std::string edinburgh_memory(const ExportScene& scene, bool elastic) {
  const auto stiffening = [&](const PairConstants& k) { return elastic ? 1 : k.stiffening; };
  const auto adhesion = [&](const PairConstants& k) { return elastic ? 0 : k.adhesion; };
  return "fix unloading all property/global UnloadingStiffness " + of_pairs(scene, stiffening) +
         "\nfix adhesion all property/global coefficientAdhesionStiffness " + of_pairs(scene, adhesion) + "\n";
}

void add_edinburgh_properties(const ExportScene& scene, const Edinburgh& edinburgh, GlobalProperties& properties) {
  const ContactModel& contact = scene.contact();
  // S_n of the card over 2 E' sqrt(R* d) of the deck.
  const double overlap_ratio = edinburgh.overlap_ratio * (is_linear(contact) ? kSpringOverlapShare : 1);
  const double spring = overlap_exponent(contact.normal) / std::sqrt(overlap_ratio);
  properties.add("overlapExponent", "scalar 1");
  properties.add("adhesionExponent", "scalar 1");
  properties.text += edinburgh_memory(scene, false);
  properties.add("pullOffForce", of_pairs(scene, [](const PairConstants& k) { return 0 - k.cohesion; }));
  properties.add("surfaceEnergy", of_pairs(scene, [](const PairConstants&) { return 0.0; }));
  properties.add("coeffMu", of_pairs(scene, [](const PairConstants&) { return 1.0; }));
  properties.add("coeffFrictionStiffness",
                 of_pairs(scene, [&](const PairConstants& k) { return k.tangential_ratio * spring; }));
  // Debian's build requires the first name, the source the second.
  for (const char* name : {"FluidViscosity", "FrictionViscosity"})
    properties.add(name, of_pairs(scene, [](const PairConstants& k) { return std::sqrt(k.tangential_ratio); }));
  properties.add("coeffRollingStiffness", of_pairs(scene, [&](const PairConstants& k) {
                   const double lever = rolling_spring_lever(contact.rolling, k.rolling_friction);
                   return 2.25 * lever * lever * spring;
                 }));
}

std::vector<std::string> edinburgh_losses(const ExportScene& scene, const Edinburgh& edinburgh) {
  const ContactModel& contact = scene.contact();
  const double overlap = edinburgh.overlap_ratio * 0.5 * scene.radius_m();
  std::vector<std::string> notes;
  if (!is_linear(contact))
    notes.push_back(
        format("Linear springs stand in for those of exponent 3/2: LIGGGHTS's own (edinburgh with the exponent 1.5) "
               "never lets a contact leave the adhesion branch, and grains fall into each other. The forces are the "
               "same at an overlap of %.3g mm of two mean grains; at half of it the deck's is %.3g times the card's. "
               "Of every load the same share is held as pull-off, %.3g.",
               1e3 * overlap, std::sqrt(2),
               contact.adhesion_ratio * contact.plasticity_ratio /
                   (1 + contact.adhesion_ratio * (1 - contact.plasticity_ratio))));
  notes.push_back(
      "Run it on one process: where a grain moves to another one, LIGGGHTS forgets how deep its contacts were "
      "pressed.");
  if (is_linear(contact))
    notes.push_back(format(
        "LIGGGHTS's tangential and rolling springs grow with the root of the overlap; they are the card's at %.3g mm.",
        1e3 * kSpringOverlapShare * overlap));
  if (contact.friction_basis == FrictionBasis::elastic)
    notes.push_back("The friction limit counts the dashpot, as \"friction_basis\": \"total\" does.");
  if (contact.friction_basis == FrictionBasis::net)
    notes.push_back(
        "Friction is that of the net force in size: where the card's contact is pulled and slips, the deck's holds mu "
        "times the pull.");
  if (contact.rolling == RollingModel::constant_torque && contact.rolling_friction > 0)
    notes.push_back(
        "In place of a torque of constant size against the spin stands a spring that slips at that moment.");
  if (edinburgh.restitution(contact.restitution) == kLowestRestitution)
    notes.push_back("The dashpot is weaker than the card's: LIGGGHTS takes no restitution below 0.05.");
  const double pull_off = cohesion_n(contact, scene.mean_pair());
  if (pull_off != 0 && scene.grains().distribution != SizeDistribution::mono)
    notes.push_back(
        format("The constant pull-off, %.4g N, is that of two mean grains; for other sizes it grows with the square of "
               "the size on the card, and not in LIGGGHTS.",
               pull_off));
  return notes;
}

}  // namespace pastefit
