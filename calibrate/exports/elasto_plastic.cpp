#include "calibrate/exports/elasto_plastic.h"

#include <array>
#include <cmath>
#include <numbers>

#include "calibrate/base/text.h"
#include "calibrate/exports/nearest_law.h"
#include "calibrate/verify/force_curve.h"
#include "core/laws/constants.h"
#include "core/laws/table.h"
#include "core/world/world.h"

namespace pastefit {

namespace {

double exponent(NormalLaw normal) {
  return normal == NormalLaw::luding ? 1 : 1.5;
}

}  // namespace

bool yields(NormalLaw normal) {
  return with_law(NormalLaws{}, normal, [](auto law) { return law.yields; });
}

std::vector<Leg> two_grain_legs(const ContactModel& contact, double radius) {
  if (!yields(contact.normal)) {
    const auto [nearest, farthest] = two_grain_distances(contact, radius);
    const double spacing = (farthest - nearest) / 240;
    return {{"apart", nearest, farthest + spacing, 241}, {"back", farthest, nearest - spacing, 241}};
  }
  // Overlaps over the radius. None is a multiple of the spacing: at an overlap of zero rounding decides on contact.
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
  const double effective = 0.5 * scene.radius_m(), m = exponent(contact.normal);
  const double k1 = grain_pair(contact, scene.radius_m()).hertz * std::pow(effective, 2 - m);
  const double plastic_power =
      contact.plasticity_ratio * std::pow(matched_overlap_ratio(scene) * effective, m);  // p^m = l d^m
  const double kc = contact.adhesion_ratio * k1, k2 = k1 / (1 - contact.plasticity_ratio);
  const double pull_off = kc * k2 / (kc + k2) * plastic_power;
  // Where spheres that overlap by p intersect: a^2 = 2 R* p for p << R.
  const double patch = std::sqrt(2 * effective * std::pow(plastic_power, 1 / m));
  return patch > 0 ? pull_off / (1.5 * std::numbers::pi * patch) : 0;
}

std::string lammps_granular_words(const ExportScene& scene) {
  const ContactModel& contact = scene.contact();
  const double m = exponent(contact.normal), effective = 0.5 * scene.radius_m();
  const double kc = contact.adhesion_ratio * grain_pair(contact, scene.radius_m()).hertz * std::pow(effective, 2 - m);
  return format("pair_coeff * * epa_nonlinear %.6g %.6g %.6g %.6g %.6g %.6g %.6g %.6g ", contact.youngs_modulus_pa,
                contact.restitution, contact.poissons_ratio, contact.plasticity_ratio,
                cohesion_n(contact, scene.mean_pair()), kc, m, m) +
         format("tangential mindlin NULL 1.0 %.6g", contact.friction);
}

std::string note_of_pull_off(const ExportScene& scene, std::string_view target) {
  const double pull_off = cohesion_n(scene.contact(), scene.mean_pair());
  if (pull_off == 0 || scene.grains().distribution == SizeDistribution::mono) return {};
  return format(
      "The constant pull-off, %.4g N, is that of two mean grains; for other sizes it grows with the square of "
      "the size on the card, and not in %s.",
      pull_off, std::string(target).c_str());
}

}  // namespace pastefit
