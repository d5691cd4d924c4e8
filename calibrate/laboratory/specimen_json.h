#pragma once

#include "calibrate/laboratory/names.h"
#include "core/apparatus/dimension.h"
#include "core/apparatus/specimen.h"

namespace pastefit {

// What tests of all kinds have in their JSON, in SI, for an `ObjectReader` and an `ObjectWriter` alike.

inline constexpr Range any_number;  ///< the test's own `validate` knows the ranges
inline constexpr Need required = Need::required;

template <class Fields, class Grains>
void describe_grains(Fields& fields, Grains& grains) {
  fields.choice("distribution", grains.distribution, size_distributions, required);
  fields.number("radius_m", grains.radius_m, any_number, required);
  fields.number("standard_deviation_m", grains.standard_deviation_m, any_number, required);
  fields.number("smallest_m", grains.smallest_m, any_number, required);
  fields.number("largest_m", grains.largest_m, any_number, required);
}

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
  for (const auto& one : surface_dimensions) fields.number(one.field.data(), wall.*one.value, any_number, required);
}

/// All of it.
template <class Fields, class Specimen>
void describe_specimen(Fields& fields, Specimen& specimen) {
  fields.number("bulk_density_kg_m3", specimen.bulk_density_kg_m3, any_number, required);
  fields.object("grains", required, [&](auto& grains) { describe_grains(grains, specimen.grains); });
  fields.object("contact", required, [&](auto& contact) { describe_contact(contact, specimen.contact); });
  fields.integer("packing_seed", specimen.packing_seed, required);
}

}  // namespace pastefit
