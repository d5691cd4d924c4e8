#pragma once

#include <array>
#include <string>
#include <type_traits>

#include "calibrate/base/field.h"
#include "core/laws/table.h"

namespace pastefit {

// Names of the laws in all files: the words for their choices, and their constants. Cards have them in JSON, decks for
// LAMMPS in a line. The LAMMPS style that reads those (data/lammps) includes this header.

inline constexpr std::array<Named<SizeDistribution>, 3> size_distributions{
    {{"mono", SizeDistribution::mono}, {"uniform", SizeDistribution::uniform}, {"normal", SizeDistribution::normal}}};

/// Takes the words from the laws.
template <class... Laws>
constexpr auto describe(TypeList<Laws...>) {
  return std::array{Named<std::remove_const_t<decltype(Laws::choice)>>{Laws::word, Laws::choice}...};
}

inline constexpr auto normal_laws = describe(NormalLaws{});
inline constexpr auto bridge_shapes = describe(Attractions{});
inline constexpr auto rolling_models = describe(RollingLaws{});

inline constexpr std::array<Named<BridgeFormation>, 2> bridge_formations{
    {{"film", BridgeFormation::film}, {"touch", BridgeFormation::touch}}};

inline constexpr std::array<Named<FrictionBasis>, 3> friction_bases{
    {{"elastic", FrictionBasis::elastic}, {"total", FrictionBasis::total}, {"net", FrictionBasis::net}}};

template <class T, std::size_t N>
std::string word_of(T value, const std::array<Named<T>, N>& words) {
  for (const auto& word : words)
    if (word.value == value) return std::string(word.name);
  return "?";
}

// Constants in SI, for an `ObjectReader`, an `ObjectWriter`, an `ObjectSchema` and a line of a deck. The test's
// `validate` checks ranges that depend on other constants.

inline constexpr Range any_number{-largest_quantity, largest_quantity, false, true};
inline constexpr Range not_below_zero{0, largest_quantity, false, true};
inline constexpr Range above_zero{0, largest_quantity, true, true};
inline constexpr Need required = Need::required;

void describe_bridge(auto& fields, auto& bridge) {
  fields.choice({"shape", "law of the attraction across the gap", "laws.schema.json#/properties/attraction"},
                bridge.shape, bridge_shapes, required);
  fields.choice(
      {"formation",
       "event that forms a bridge; film: the liquid shells of two grains touch; touch: the grains themselves touch"},
      bridge.formation, bridge_formations, required);
  fields.number({"a_n_m2", "coefficient a of the polynomial"}, bridge.a_n_m2, any_number, required);
  fields.number({"b_n_m", "coefficient b of the polynomial"}, bridge.b_n_m, any_number, required);
  fields.number({"c_n", "attraction at touch, c"}, bridge.c_n, not_below_zero, required);
  fields.number({"d_c_m", "d_c: the rupture gap with a negative sign"}, bridge.d_c_m,
                {-largest_quantity, 0, false, true}, required);
  fields.number({"offset_m", "thickness of the liquid shell of a grain"}, bridge.offset_m, not_below_zero, required);
  fields.number({"liquid_volume_m3", "liquid volume of a capillary bridge"}, bridge.liquid_volume_m3, not_below_zero,
                required);
  fields.number({"surface_tension_n_m", "surface tension of a capillary bridge"}, bridge.surface_tension_n_m,
                not_below_zero, required);
  fields.number({"contact_angle_rad", "contact angle of a capillary bridge on a grain"}, bridge.contact_angle_rad,
                not_below_zero, required);
  fields.number({"viscosity_pa_s", "viscosity of the liquid between the grains; default 0"}, bridge.viscosity_pa_s,
                not_below_zero, Default{0.0});
}

void describe_contact(auto& fields, auto& contact) {
  fields.shared("contact");
  fields.number({"youngs_modulus_pa", "Young's modulus of the grains"}, contact.youngs_modulus_pa, above_zero,
                required);
  fields.number({"poissons_ratio", "Poisson's ratio of the grains"}, contact.poissons_ratio, not_below_zero, required);
  fields.number({"restitution", "rebound speed divided by impact speed, without attraction"}, contact.restitution,
                not_below_zero, required);
  fields.number({"friction", "sliding friction between grains"}, contact.friction, not_below_zero, required);
  fields.number({"rolling_friction", "rolling friction between grains"}, contact.rolling_friction, not_below_zero,
                required);
  fields.choice({"rolling", "law of the rolling resistance", "laws.schema.json#/properties/rolling"}, contact.rolling,
                rolling_models, required);
  fields.choice({"friction_basis", "normal force in the friction limit, as in study files"}, contact.friction_basis,
                friction_bases, required);
  fields.choice({"normal", "force law of overlapping grains; default hertz", "laws.schema.json#/properties/normal"},
                contact.normal, normal_laws, Default{NormalLaw::hertz});
  fields.number({"surface_energy_j_m2", "surface energy gamma of the laws jkr and dmt: half the work of adhesion"},
                contact.surface_energy_j_m2, not_below_zero, Default{0.0});
  fields.number({"cohesion_energy_density_pa", "constant k of the law sjkr: attraction divided by contact area"},
                contact.cohesion_energy_density_pa, not_below_zero, Default{0.0});
  fields.number({"plasticity_ratio", "constant 1 - k1/k2 of the laws epa and luding"}, contact.plasticity_ratio,
                not_below_zero, Default{0.0});
  fields.number({"adhesion_ratio", "constant kc/k1 of the laws epa and luding"}, contact.adhesion_ratio, not_below_zero,
                Default{0.0});
  fields.nullable_number({"cohesion_n", "constant attraction of overlapping grains; null: equal to c_n of the bridge"},
                         contact.cohesion_n, not_below_zero, required);
  fields.object({"bridge",
                 "attraction across a gap between grains of the mean radius; polynomial: a d^2 + b d + c for d_c <= d "
                 "<= 0, where -d is the gap"},
                required, [&](auto& inner) { describe_bridge(inner, contact.bridge); });
}

void describe_wall(auto& fields, auto& wall) {
  fields.shared("wall");
  fields.number({"youngs_modulus_pa", "Young's modulus of the wall"}, wall.youngs_modulus_pa, above_zero, required);
  fields.number({"poissons_ratio", "Poisson's ratio of the wall"}, wall.poissons_ratio, not_below_zero, required);
  fields.number({"restitution", "rebound speed divided by impact speed, without attraction"}, wall.restitution,
                {0.001, 1, false, true}, required);
  fields.number({"friction", "sliding friction of grains on this surface"}, wall.friction, {0, 10, false, true},
                required);
  fields.number({"rolling_friction", "rolling friction of grains on this surface"}, wall.rolling_friction,
                {0, 10, false, true}, required);
  fields.number({"cohesion_factor", "share of the grains' attraction that acts on this surface"}, wall.cohesion_factor,
                {0, 10, false, true}, required);
}

}  // namespace pastefit
