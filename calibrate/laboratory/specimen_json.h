#pragma once

#include "calibrate/laboratory/names.h"
#include "core/apparatus/dimension.h"
#include "core/apparatus/specimen.h"

namespace pastefit {

// What tests of all kinds have in their JSON, in SI, for an `ObjectReader` and an `ObjectWriter` alike.

template <class Fields, class Grains>
void describe_grains(Fields& fields, Grains& grains) {
  fields.choice("distribution", grains.distribution, size_distributions, required);
  fields.number("radius_m", grains.radius_m, any_number, required);
  fields.number("standard_deviation_m", grains.standard_deviation_m, any_number, required);
  fields.number("smallest_m", grains.smallest_m, any_number, required);
  fields.number("largest_m", grains.largest_m, any_number, required);
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
