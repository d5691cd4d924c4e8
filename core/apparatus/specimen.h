#pragma once

#include <cstdint>

#include "core/laws/materials.h"

namespace pastefit {

/// What every test starts with: the grains of a material, and which of their random packings.
struct Specimen {
  double bulk_density_kg_m3 = 2300;  ///< of the material as the laboratory prepares it
  GrainSizes grains;
  ContactModel contact;
  std::uint64_t packing_seed = 1;
};

/// The radius of the largest grain that these sizes allow.
double largest_radius(const GrainSizes& sizes);

/// Radius of grain n of a scene, from the stream "grain-radius". Pure function of its arguments.
double draw_radius(const GrainSizes& sizes, std::uint64_t seed, std::uint64_t n);

}  // namespace pastefit
