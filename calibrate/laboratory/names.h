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
  fields.choice({"shape", "of the force over the gap", "laws.schema.json#/properties/attraction"}, bridge.shape,
                bridge_shapes, required);
  fields.choice({"formation", "a bridge forms when liquid shells touch (film), or grains (touch)"}, bridge.formation,
                bridge_formations, required);
  fields.number({"a_n_m2", "a"}, bridge.a_n_m2, any_number, required);
  fields.number({"b_n_m", "b"}, bridge.b_n_m, any_number, required);
  fields.number({"c_n", "c, the attraction at touch"}, bridge.c_n, not_below_zero, required);
  fields.number({"d_c_m", "d_c, minus the gap at which it ruptures"}, bridge.d_c_m, {-largest_quantity, 0, false, true},
                required);
  fields.number({"offset_m", "thickness of the liquid shell of a grain"}, bridge.offset_m, not_below_zero, required);
  fields.number({"liquid_volume_m3", "of a capillary bridge"}, bridge.liquid_volume_m3, not_below_zero, required);
  fields.number({"surface_tension_n_m", "of its liquid"}, bridge.surface_tension_n_m, not_below_zero, required);
  fields.number({"contact_angle_rad", "of its liquid on the grain"}, bridge.contact_angle_rad, not_below_zero,
                required);
  fields.number({"viscosity_pa_s", "of the liquid between the grains; 0 where it is not said"}, bridge.viscosity_pa_s,
                not_below_zero, Default{0.0});
}

void describe_contact(auto& fields, auto& contact) {
  fields.shared("contact");
  fields.number({"youngs_modulus_pa", "of the grains"}, contact.youngs_modulus_pa, above_zero, required);
  fields.number({"poissons_ratio", "of the grains"}, contact.poissons_ratio, not_below_zero, required);
  fields.number({"restitution", "rebound speed over impact speed, without attraction"}, contact.restitution,
                not_below_zero, required);
  fields.number({"friction", "sliding friction"}, contact.friction, not_below_zero, required);
  fields.number({"rolling_friction", "rolling friction"}, contact.rolling_friction, not_below_zero, required);
  fields.choice({"rolling", "resistance to rolling", "laws.schema.json#/properties/rolling"}, contact.rolling,
                rolling_models, required);
  fields.choice({"friction_basis", "what the friction limit is a share of"}, contact.friction_basis, friction_bases,
                required);
  fields.choice({"normal", "law of the overlap; hertz where it is not said", "laws.schema.json#/properties/normal"},
                contact.normal, normal_laws, Default{NormalLaw::hertz});
  fields.number({"surface_energy_j_m2", "gamma of jkr and dmt, half the work of adhesion"}, contact.surface_energy_j_m2,
                not_below_zero, Default{0.0});
  fields.number({"cohesion_energy_density_pa", "k of sjkr, attraction over the area in which grains meet"},
                contact.cohesion_energy_density_pa, not_below_zero, Default{0.0});
  fields.number({"plasticity_ratio", "of epa and luding, 1 - k1/k2"}, contact.plasticity_ratio, not_below_zero,
                Default{0.0});
  fields.number({"adhesion_ratio", "of epa and luding, kc/k1"}, contact.adhesion_ratio, not_below_zero, Default{0.0});
  fields.nullable_number({"cohesion_n", "constant attraction in overlap; null: c_n of the bridge"}, contact.cohesion_n,
                         not_below_zero, required);
  fields.object({"bridge", "attraction a d^2 + b d + c for d_c <= d <= 0 between grains of the mean radius"}, required,
                [&](auto& inner) { describe_bridge(inner, contact.bridge); });
}

void describe_wall(auto& fields, auto& wall) {
  fields.shared("wall");
  fields.number({"youngs_modulus_pa", "of the wall"}, wall.youngs_modulus_pa, above_zero, required);
  fields.number({"poissons_ratio", "of the wall"}, wall.poissons_ratio, not_below_zero, required);
  fields.number({"restitution", "rebound speed over impact speed, without attraction"}, wall.restitution,
                {0.001, 1, false, true}, required);
  fields.number({"friction", "sliding friction of granules on it"}, wall.friction, {0, 10, false, true}, required);
  fields.number({"rolling_friction", "rolling friction of granules on it"}, wall.rolling_friction, {0, 10, false, true},
                required);
  fields.number({"cohesion_factor", "share of the granules' attraction that acts on it"}, wall.cohesion_factor,
                {0, 10, false, true}, required);
}

}  // namespace pastefit
