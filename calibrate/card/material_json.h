#pragma once

#include <array>

#include "calibrate/laboratory/specimen_json.h"

namespace pastefit {

/// What a test has of the material, in the JSON of either: a test that does not say it has the material's.
inline constexpr std::array of_material{"bulk_density_kg_m3", "grains", "contact"};

/// The same, for an `ObjectReader` and an `ObjectWriter`.
template <class Fields, class Material>
void describe_material(Fields& fields, Material& material) {
  fields.number("bulk_density_kg_m3", material.bulk_density_kg_m3, Range{}, Need::required);
  fields.object("grains", Need::required, [&](auto& grains) { describe_grains(grains, material.grains); });
  fields.object("contact", Need::required, [&](auto& contact) { describe_contact(contact, material.contact); });
}

}  // namespace pastefit
