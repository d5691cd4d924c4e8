#include "calibrate/exports/nearest_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "calibrate/base/text.h"
#include "calibrate/laboratory/names.h"
#include "core/laws/constants.h"
#include "core/laws/table.h"

namespace pastefit {

namespace {

using std::numbers::pi;

template <class T, std::size_t N>
void look(T chosen, const std::vector<T>& known, const std::array<Named<T>, N>& words, const std::string& place,
          const std::string& key, std::string_view target, Faults& faults) {
  if (std::ranges::count(known, chosen) > 0) return;
  const auto quoted = [&](T one) { return in_quotes(word_of(one, words)); };
  faults.push_back({place, "is " + quoted(chosen) + ", which " + std::string(target) + " lacks",
                    "export to another target, or calibrate with " + key + " " + listed(known, quoted, " or ")});
}

/// `pair`: constants of reference bodies with this R*.
Sticking sticking(NormalLaw normal, const PairConstants& pair, double effective_radius) {
  if (acting(normal, pair) == NormalLaw::hertz) return {};
  return with_law(NormalLaws{}, normal, [&](auto law) {
    Sticking out;
    const double root = std::sqrt(effective_radius);
    out.resting_overlap_m = law.overlap_under(pair, effective_radius, 0.0);
    if (law.reaches) out.part_gap_m = pair.pull_off_gap;
    const auto rest = law.at(pair, root, out.resting_overlap_m, 1.0);
    out.load_n = rest.load;
    out.reserve_n = rest.reserve;
    if constexpr (decltype(law)::adheres) out.work_j = -law.energy(pair, effective_radius, rest, out.resting_overlap_m);
    const double touch = 1e-12 * out.resting_overlap_m;  // laws without range have no attraction at zero overlap
    out.at_touch_n = -law.at(pair, root, touch, 1.0).force;
    // The attraction has a single maximum between separation and rest.
    double low = law.reaches ? -out.part_gap_m : touch, high = out.resting_overlap_m;
    for (int step = 0; step < 200; ++step) {
      const double third = (high - low) / 3;
      const bool lower = law.at(pair, root, low + third, 1.0).force < law.at(pair, root, high - third, 1.0).force;
      (lower ? high : low) += lower ? -third : third;
    }
    out.pull_off_n = -law.at(pair, root, low, 1.0).force;
    if (out.at_touch_n < 1e-9 * out.pull_off_n) out.at_touch_n = 0;
    return out;
  });
}

}  // namespace

Sticking sticking_of(const ContactModel& contact, double effective_radius) {
  return sticking(contact.normal, grain_pair(contact, 2 * effective_radius), effective_radius);
}

Sticking sticking_of(const ContactModel& contact, const WallContact& wall, double radius) {
  return sticking(contact.normal, wall_pair(contact, wall, radius), radius);
}

Distances two_grain_distances(const ContactModel& contact, double radius) {
  const Sticking grains = sticking_of(contact, 0.5 * radius);
  const double reach = std::max({bridge_gaps(contact, {radius, radius, radius}).rupture_m, grains.part_gap_m});
  return {2 * radius - std::max(0.05 * radius, 1.2 * grains.resting_overlap_m),
          2 * radius + 1.05 * std::max(reach, 0.05 * radius)};
}

double sjkr_energy_density(double pull_off, double effective_radius, double effective_modulus) {
  const double share = effective_modulus / effective_radius;
  return std::cbrt(1.5 * pull_off * share * share / (pi * pi * pi));
}

ContactModel with_nearest_law(const ContactModel& contact, NormalLaw law, double radius) {
  const double effective_radius = 0.5 * radius;
  const double pull_off = sticking_of(contact, effective_radius).pull_off_n;
  if (contact.normal == law || pull_off == 0) return contact;
  ContactModel out = contact;
  out.normal = law;
  out.surface_energy_j_m2 = out.cohesion_energy_density_pa = 0;
  if (law == NormalLaw::dmt)
    out.surface_energy_j_m2 = pull_off / (4 * pi * effective_radius);
  else
    out.cohesion_energy_density_pa =
        sjkr_energy_density(pull_off, effective_radius, 0.75 * grain_pair(contact, radius).hertz);
  return out;
}

double held_normal_force_n(const ContactModel& contact, const Sticking& grains) {
  if (contact.friction_basis == FrictionBasis::elastic) return grains.load_n;
  return contact.friction_basis == FrictionBasis::total ? grains.reserve_n : 0;
}

std::vector<std::string> differences_of_sticking(const ExportScene& scene, const ContactModel& written,
                                                 std::string_view target, double held) {
  const ContactModel& contact = scene.contact();
  if (contact.normal == written.normal) return {};
  const double radius = scene.radius_m();
  const Sticking card = sticking_of(contact, 0.5 * radius), deck = sticking_of(written, 0.5 * radius);
  const std::string own = word_of(contact.normal, normal_laws), other = word_of(written.normal, normal_laws);
  const bool by_area = written.normal == NormalLaw::sjkr;
  std::vector<std::string> notes{
      format("%s has no %s. In its place stands %s with %s %.6g %s, which parts two grains of the mean radius by the "
             "same force, %.4g N. Another size needs another number: export a card of that size (pastefit rescale).",
             std::string(target), own, other, by_area ? "a cohesion energy density of" : "a surface energy of",
             by_area ? written.cohesion_energy_density_pa : written.surface_energy_j_m2, by_area ? "Pa" : "J/m^2",
             deck.pull_off_n)};
  notes.push_back(
      format("Two mean grains that only stick overlap by %.3g mm in the deck, %.3g of their radius; on the card by "
             "%.3g mm. At touch they attract each other with %.3g N in the deck, %.3g N on the card.",
             1e3 * deck.resting_overlap_m, deck.resting_overlap_m / radius, 1e3 * card.resting_overlap_m,
             deck.at_touch_n, card.at_touch_n));
  notes.push_back(
      format("They part at a gap of %.3g mm in the deck, %.3g mm on the card; to part them costs %.3g J in the deck, "
             "%.3g J on the card, %.3g of it.",
             1e3 * deck.part_gap_m, 1e3 * card.part_gap_m, deck.work_j, card.work_j, deck.work_j / card.work_j));
  if (scene.grains().distribution != SizeDistribution::mono && by_area) {
    std::string sizes;
    for (const double size : {scene.grains().smallest_m, scene.grains().largest_m})
      sizes +=
          format("%s%.4g N in the deck and %.4g N on the card between grains of %.3g mm", sizes.empty() ? "" : ", ",
                 sticking_of(written, 0.5 * size).pull_off_n, sticking_of(contact, 0.5 * size).pull_off_n, 1e3 * size);
    notes.push_back(
        "The pull-off grows with the square of the size in the deck, in proportion to it on the card: " + sizes + ".");
  }
  notes.push_back(
      format("Friction of two mean grains that only stick holds %.3g N in the deck, %.3g N on the card (%s).",
             contact.friction * held, contact.friction * held_normal_force_n(contact, card),
             word_of(contact.friction_basis, friction_bases)));
  return notes;
}

ExportFile sticking_curves(const ExportScene& scene, const ContactModel& written, std::string_view target) {
  constexpr int kPoints = 401;
  const double radius = scene.radius_m(), effective_radius = 0.5 * radius;
  const Distances card = two_grain_distances(scene.contact(), radius), deck = two_grain_distances(written, radius);
  const double deepest = 2 * radius - std::min(card.nearest_m, deck.nearest_m);
  const double reach = 1.05 * sticking_of(scene.contact(), effective_radius).part_gap_m;
  std::string text = "overlap_m,card_n," + std::string(target) + "_n\n";
  for (int i = 0; i < kPoints; ++i) {
    const double overlap = -reach + (deepest + reach) * i / (kPoints - 1);
    text += format("%.17g", overlap);
    for (const ContactModel* contact : {&scene.contact(), &written}) {
      const PairConstants pair = grain_pair(*contact, radius);
      text += format(",%.17g", with_law(NormalLaws{}, contact->normal, [&](auto law) {
                       return law.at(pair, std::sqrt(effective_radius), overlap, 1.0).force;
                     }));
    }
    text += "\n";
  }
  return {"curves.csv", text};
}

Faults unknown_laws(const ContactModel& contact, const KnownLaws& known) {
  Faults faults;
  look(contact.normal, known.normal, normal_laws, "test.contact.normal", "normal", known.target, faults);
  look(contact.rolling, known.rolling, rolling_models, "test.contact.rolling", "rolling_model", known.target, faults);
  if (!known.attraction.empty())
    look(contact.bridge.shape, known.attraction, bridge_shapes, "test.contact.bridge.shape", "attraction", known.target,
         faults);
  if (contact.bridge.viscosity_pa_s > 0 && !known.viscosity)
    faults.push_back({"test.contact.bridge.viscosity_pa_s",
                      "is not 0, but " + std::string(known.target) + " lacks the viscosity of a bridge",
                      "export to another target, or calibrate with viscosity_pa_s 0"});
  return faults;
}

double rolling_spring_lever(RollingModel rolling, double rolling_friction) {
  return rolling == RollingModel::constant_torque ? 1 : rolling_friction;
}

std::string note_of_constant_torque(const ExportScene& scene, double load) {
  const ContactModel& contact = scene.contact();
  if (contact.rolling != RollingModel::constant_torque || contact.rolling_friction == 0) return {};
  const double radius = 0.5 * scene.radius_m();
  const PairConstants pair = grain_pair(contact, scene.radius_m());
  const double turn = with_law(NormalLaws{}, acting(contact.normal, pair), [&](auto law) {
    const auto normal_force = law.at(pair, std::sqrt(radius), law.overlap_under(pair, radius, load), 1.0);
    return pair.rolling_friction * normal_force.load /
           (2.25 * pair.normal_stiffness * normal_force.contact_radius * radius);
  });
  return format(
      "The card's rolling resistance is a torque of constant size against the spin. In its place stands a spring that "
      "slips at the same moment; two mean grains under %.3g N turn by %.2g rad until it does.",
      load, turn);
}

double SoulieBridge::rupture_gap_m() const {
  return std::cbrt(volume_m3);
}

double SoulieBridge::force_n(double gap) const {
  if (gap >= rupture_gap_m()) return 0;
  const double v = volume_m3 / (radius_m * radius_m * radius_m), ln = std::log(v);
  const double a = -1.1 * std::pow(v, -0.53), b = 0.48 - 0.0082 * ln, c = 0.078 + 0.0018 * ln;
  return pi * surface_tension_n_m * radius_m * (std::exp(a * gap / radius_m + b) + c);
}

SoulieFit fit_soulie(const ContactModel& contact, double radius) {
  constexpr int kGaps = 400, kVolumes = 200;
  const GrainPair pair{radius, radius, radius};
  const double reach = bridge_gaps(contact, pair).rupture_m, peak = attraction_n(contact, pair, 0);
  const double farthest = 1.5 * reach;
  std::vector<double> gaps, card;
  double card_work = 0;
  for (int i = 0; i < kGaps; ++i) {
    gaps.push_back(farthest * (i + 0.5) / kGaps);
    card.push_back(attraction_n(contact, pair, -gaps.back()));
    card_work += card.back() * farthest / kGaps;
  }
  SoulieFit best;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < kVolumes; ++n) {
    const double rupture = reach * (0.5 + n / (kVolumes - 1.0));
    SoulieBridge bridge{radius, rupture * rupture * rupture, 1};
    double both = 0, own = 0, squares = 0, largest = 0, work = 0;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const double force = bridge.force_n(gaps[i]);
      both += force * card[i];
      own += force * force;
    }
    bridge.surface_tension_n_m = both / own;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const double fitted = bridge.force_n(gaps[i]);
      squares += (fitted - card[i]) * (fitted - card[i]) / kGaps;
      largest = std::max(largest, std::abs(fitted - card[i]));
      work += fitted * farthest / kGaps;
    }
    if (squares >= least) continue;
    least = squares;
    best = {bridge, largest / peak, std::sqrt(squares) / peak, work / card_work - 1};
  }
  return best;
}

}  // namespace pastefit
