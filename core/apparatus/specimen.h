#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/laws/materials.h"
#include "core/vec3.h"

namespace pastefit {

/// Common to all tests: grains, contact laws, and the seed of the packing.
struct Specimen {
  double bulk_density_kg_m3 = 2300;  ///< of the material as prepared in the laboratory
  GrainSizes grains;
  ContactModel contact;
  std::uint64_t packing_seed = 1;
};

/// Radius of the largest grain that these sizes allow.
double largest_radius(const GrainSizes& sizes);

/// Radius of grain n, from the stream "grain-radius". Pure function.
double draw_radius(const GrainSizes& sizes, std::uint64_t seed, std::uint64_t n);

/// Grains without a world.
struct LooseGrains {
  std::vector<Vec3> centres;
  std::vector<double> radii;
  double solid_volume_m3 = 0;
};

/// Loose grains on a jittered lattice above z = 0, from the bottom up, until they have this solid volume.
/// `inner_radius(z)`: of the vessel around the axis x = y = 0; at most `widest_m`.
LooseGrains pour(const GrainSizes& sizes, std::uint64_t seed, double solid_volume_m3, double widest_m,
                 const std::function<double(double)>& inner_radius);

/// A box to pour into: 0 <= x < `length_m`, periodic, with sides at y = +-`width_m`/2, above `floor_m`.
struct OpenBox {
  double length_m = 0, width_m = 0, floor_m = 0;
};

/// The same in a box. Requirement: two of the largest grains fit across each side.
LooseGrains pour(const GrainSizes& sizes, std::uint64_t seed, double solid_volume_m3, const OpenBox& box);

/// 4/3 pi r^3.
double sphere_volume_m3(double radius_m);

/// Highest point of any grain [m]; 0 if there is none.
double top_of(const LooseGrains& grains);

}  // namespace pastefit
