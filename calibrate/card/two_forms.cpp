#include "calibrate/card/two_forms.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/base/format.h"
#include "calibrate/study/parameters.h"

namespace pastefit {

namespace {

using Numbers = std::vector<std::pair<std::string, double>>;

Numbers numbers_of(const ContactModel& contact) {
  const Bridge& bridge = contact.bridge;
  return {{"bridge.a_n_m2", bridge.a_n_m2},
          {"bridge.b_n_m", bridge.b_n_m},
          {"bridge.c_n", bridge.c_n},
          {"bridge.d_c_m", bridge.d_c_m},
          {"bridge.offset_m", bridge.offset_m},
          {"bridge.liquid_volume_m3", bridge.liquid_volume_m3},
          {"bridge.surface_tension_n_m", bridge.surface_tension_n_m},
          {"bridge.contact_angle_rad", bridge.contact_angle_rad},
          {"bridge.viscosity_pa_s", bridge.viscosity_pa_s},
          {"surface_energy_j_m2", contact.surface_energy_j_m2},
          {"cohesion_energy_density_pa", contact.cohesion_energy_density_pa},
          {"plasticity_ratio", contact.plasticity_ratio},
          {"adhesion_ratio", contact.adhesion_ratio},
          {"cohesion_n", contact.cohesion_n.value_or(bridge.c_n)},
          {"friction", contact.friction},
          {"rolling_friction", contact.rolling_friction},
          {"restitution", contact.restitution},
          {"youngs_modulus_pa", contact.youngs_modulus_pa},
          {"poissons_ratio", contact.poissons_ratio}};
}

Numbers numbers_of_surfaces(Test test) {
  Numbers numbers;
  for (const Surface& surface : surfaces_of(test)) {
    const std::string place = std::string(surface.name) + "_wall.";
    numbers.emplace_back(place + "friction", surface.contact.friction);
    numbers.emplace_back(place + "rolling_friction", surface.contact.rolling_friction);
    numbers.emplace_back(place + "cohesion_factor", surface.contact.cohesion_factor);
  }
  return numbers;
}

void compare(const std::string& place, const Numbers& in_si, const Numbers& expected, const std::vector<double>& scales,
             Faults& faults) {
  for (std::size_t i = 0; i < in_si.size(); ++i) {
    const double scale = i < scales.size() ? scales[i] : std::abs(expected[i].second);
    if (std::abs(in_si[i].second - expected[i].second) <= 1e-9 * scale) continue;
    faults.push_back(
        {place + in_si[i].first,
         format("is %.12g, but the card's \"material.parameters\" give %.12g", in_si[i].second, expected[i].second),
         "undo the change; another material: pastefit simulate CARD --set parameters.NAME=VALUE"});
  }
}

/// Whether a test's contact laws in SI are the material's, which are compared once.
bool has_contact_of(const Material& material, const Specimen& specimen) {
  return specimen.grains.radius_m == material.grains.radius_m &&
         numbers_of(specimen.contact) == numbers_of(material.contact);
}

void compare_contacts(const std::string& place, const ContactModel& in_si, const ContactModel& expected,
                      Faults& faults) {
  // Of a and b, which are small differences of larger numbers, nine digits of the larger ones.
  const Bridge& bridge = expected.bridge;
  const bool polynomial = bridge.shape == BridgeShape::polynomial;
  const double slope = polynomial ? bridge.c_n / -bridge.d_c_m : 0, curvature = polynomial ? slope / -bridge.d_c_m : 0;
  compare(place, numbers_of(in_si), numbers_of(expected), {curvature, slope}, faults);
}

}  // namespace

Faults differing_forms(const Card& card) {
  const std::vector<double> values = values_of(card.material);
  Faults faults;
  Test any;  // of whatever kind: the contact laws follow from the grains
  specimen_of(any).grains = card.material.grains;
  specimen_of(any).contact = card.material.contact;
  compare_contacts("material.contact.", card.material.contact, specimen_of(with_contact_of(any, values)).contact,
                   faults);
  for (std::size_t i = 0; i < card.tests.size(); ++i) {
    const Test& test = card.tests[i].test;
    const Test expected = with_contact_of(test, values);
    const std::string place = "tests[" + std::to_string(i) + "].test.";
    if (!has_contact_of(card.material, specimen_of(test)))
      compare_contacts(place + "contact.", specimen_of(test).contact, specimen_of(expected).contact, faults);
    compare(place, numbers_of_surfaces(test), numbers_of_surfaces(expected), {}, faults);
  }
  return faults;
}

}  // namespace pastefit
