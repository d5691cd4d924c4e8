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

Numbers numbers_of(Test test) {
  const ContactModel& contact = specimen_of(test).contact;
  const Bridge& bridge = contact.bridge;
  Numbers numbers{{"test.contact.bridge.a_n_m2", bridge.a_n_m2},
                  {"test.contact.bridge.b_n_m", bridge.b_n_m},
                  {"test.contact.bridge.c_n", bridge.c_n},
                  {"test.contact.bridge.d_c_m", bridge.d_c_m},
                  {"test.contact.bridge.offset_m", bridge.offset_m},
                  {"test.contact.bridge.liquid_volume_m3", bridge.liquid_volume_m3},
                  {"test.contact.bridge.surface_tension_n_m", bridge.surface_tension_n_m},
                  {"test.contact.bridge.contact_angle_rad", bridge.contact_angle_rad},
                  {"test.contact.surface_energy_j_m2", contact.surface_energy_j_m2},
                  {"test.contact.cohesion_n", contact.cohesion_n.value_or(bridge.c_n)},
                  {"test.contact.friction", contact.friction},
                  {"test.contact.rolling_friction", contact.rolling_friction},
                  {"test.contact.restitution", contact.restitution},
                  {"test.contact.youngs_modulus_pa", contact.youngs_modulus_pa},
                  {"test.contact.poissons_ratio", contact.poissons_ratio}};
  for (const Surface& surface : surfaces_of(test)) {
    const std::string place = "test." + std::string(surface.name) + "_wall.";
    numbers.emplace_back(place + "friction", surface.contact.friction);
    numbers.emplace_back(place + "cohesion_factor", surface.contact.cohesion_factor);
  }
  return numbers;
}

}  // namespace

Faults differing_forms(const Card& card) {
  std::vector<double> values;
  for (const Parameter& parameter : card.parameters) values.push_back(parameter.value);
  const Test from_parameters = with_contact_of(card.test, values);
  const Numbers in_si = numbers_of(card.test), expected = numbers_of(from_parameters);
  // Of numbers that are small differences of larger ones, such as a, nine digits of the larger ones.
  const Bridge& bridge = specimen_of(from_parameters).contact.bridge;
  const bool polynomial = bridge.shape == BridgeShape::polynomial;
  const double slope = polynomial ? bridge.c_n / -bridge.d_c_m : 0, curvature = polynomial ? slope / -bridge.d_c_m : 0;
  Faults faults;
  for (std::size_t i = 0; i < in_si.size(); ++i) {
    const double scale = i == 0 ? curvature : (i == 1 ? slope : std::abs(expected[i].second));
    if (std::abs(in_si[i].second - expected[i].second) <= 1e-9 * scale) continue;
    faults.push_back({in_si[i].first,
                      format("is %.12g, but the card's \"parameters\" give %.12g", in_si[i].second, expected[i].second),
                      "undo the change; another material: pastefit simulate CARD --set parameters.NAME=VALUE"});
  }
  return faults;
}

}  // namespace pastefit
