#pragma once

#include <array>
#include <string_view>

#include "calibrate/laboratory/names.h"
#include "core/apparatus/specimen.h"
#include "core/laws/materials.h"

namespace pastefit {

// Common JSON of all kinds of tests, in SI, for an `ObjectReader`, an `ObjectWriter` and an `ObjectSchema`. The test's
// `validate` checks ranges that depend on other numbers.

void describe_grains(auto& fields, auto& grains) {
  fields.shared("grains");
  fields.choice({"distribution", "distribution of the radii, as in laboratory files"}, grains.distribution,
                size_distributions, required);
  fields.number({"radius_m", "mean radius"}, grains.radius_m, above_zero, required);
  fields.number(
      {"standard_deviation_m", "standard deviation of the radius; 0 for a distribution without this parameter"},
      grains.standard_deviation_m, not_below_zero, required);
  fields.number({"smallest_m", "smallest radius"}, grains.smallest_m, not_below_zero, required);
  fields.number({"largest_m", "largest radius"}, grains.largest_m, not_below_zero, required);
}

/// Properties shared by tests of one material.
void describe_material(auto& fields, auto& material) {
  fields.number({"bulk_density_kg_m3", "bulk density, as in the laboratory file"}, material.bulk_density_kg_m3,
                above_zero, required);
  fields.object({"grains", "grain sizes for which the numbers in `contact` are valid"}, required,
                [&](auto& grains) { describe_grains(grains, material.grains); });
  fields.object({"contact", "contact laws in SI units, for input into another program"}, required,
                [&](auto& contact) { describe_contact(contact, material.contact); });
}
inline constexpr std::array of_material{"bulk_density_kg_m3", "grains", "contact"};

/// Everything in a `Specimen`.
void describe_specimen(auto& fields, auto& specimen) {
  describe_material(fields, specimen);
  fields.integer({"packing_seed", "seed of the default packing"}, specimen.packing_seed, required);
}

/// Surface of the apparatus in contact with grains. Its parameters are `<name>_friction`, `<name>_rolling_friction` and
/// `<name>_cohesion_factor`.
struct Surface {
  std::string_view name;
  WallContact& contact;
};

}  // namespace pastefit
