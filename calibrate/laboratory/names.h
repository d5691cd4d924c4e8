#pragma once

#include <array>
#include <string>
#include <type_traits>

#include "calibrate/base/field.h"
#include "core/laws/table.h"

namespace pastefit {

// How all files call the laws: the words for their choices, one row for one value, and their numbers, each with its
// name. Cards have them in JSON, decks for LAMMPS in a line; the style that reads those (data/lammps) takes this header
// along.

inline constexpr std::array<Named<SizeDistribution>, 3> size_distributions{
    {{"mono", SizeDistribution::mono}, {"uniform", SizeDistribution::uniform}, {"normal", SizeDistribution::normal}}};

/// Laws bring their words with them.
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

/// The word for a choice of a test.
template <class T, std::size_t N>
std::string word_of(T value, const std::array<Named<T>, N>& words) {
  for (const auto& word : words)
    if (word.value == value) return std::string(word.name);
  return "?";
}

// The numbers in SI, for an `ObjectReader`, an `ObjectWriter` and the words of a deck alike.

inline constexpr Range any_number;  ///< the test's own `validate` knows the ranges
inline constexpr Need required = Need::required;

template <class Fields, class Model>
void describe_bridge(Fields& fields, Model& bridge) {
  fields.choice("shape", bridge.shape, bridge_shapes, required);
  fields.choice("formation", bridge.formation, bridge_formations, required);
  fields.number("a_n_m2", bridge.a_n_m2, any_number, required);
  fields.number("b_n_m", bridge.b_n_m, any_number, required);
  fields.number("c_n", bridge.c_n, any_number, required);
  fields.number("d_c_m", bridge.d_c_m, any_number, required);
  fields.number("offset_m", bridge.offset_m, any_number, required);
  fields.number("liquid_volume_m3", bridge.liquid_volume_m3, any_number, required);
  fields.number("surface_tension_n_m", bridge.surface_tension_n_m, any_number, required);
  fields.number("contact_angle_rad", bridge.contact_angle_rad, any_number, required);
  fields.number("viscosity_pa_s", bridge.viscosity_pa_s, any_number, Default{0.0});
}

template <class Fields, class Model>
void describe_contact(Fields& fields, Model& contact) {
  fields.number("youngs_modulus_pa", contact.youngs_modulus_pa, any_number, required);
  fields.number("poissons_ratio", contact.poissons_ratio, any_number, required);
  fields.number("restitution", contact.restitution, any_number, required);
  fields.number("friction", contact.friction, any_number, required);
  fields.number("rolling_friction", contact.rolling_friction, any_number, required);
  fields.choice("rolling", contact.rolling, rolling_models, required);
  fields.choice("friction_basis", contact.friction_basis, friction_bases, required);
  fields.choice("normal", contact.normal, normal_laws, Default{NormalLaw::hertz});
  fields.number("surface_energy_j_m2", contact.surface_energy_j_m2, any_number, Default{0.0});
  fields.number("cohesion_energy_density_pa", contact.cohesion_energy_density_pa, any_number, Default{0.0});
  fields.number("plasticity_ratio", contact.plasticity_ratio, any_number, Default{0.0});
  fields.number("adhesion_ratio", contact.adhesion_ratio, any_number, Default{0.0});
  fields.nullable_number("cohesion_n", contact.cohesion_n, any_number, required);
  fields.object("bridge", required, [&](auto& inner) { describe_bridge(inner, contact.bridge); });
}

template <class Fields, class Wall>
void describe_wall(Fields& fields, Wall& wall) {
  fields.number("youngs_modulus_pa", wall.youngs_modulus_pa, any_number, required);
  fields.number("poissons_ratio", wall.poissons_ratio, any_number, required);
  fields.number("restitution", wall.restitution, any_number, required);
  fields.number("friction", wall.friction, any_number, required);
  fields.number("rolling_friction", wall.rolling_friction, any_number, required);
  fields.number("cohesion_factor", wall.cohesion_factor, any_number, required);
}

}  // namespace pastefit
