#pragma once

#include <cstdint>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/vec3.h"

namespace pastefit {

/// Inner radius at height z of the mould and of an unlimited straight hopper on top of it [m].
double inner_radius(const Mould& mould, double z);

/// Random sequential addition (Widom 1966): spheres are placed in mould and hopper one after the other, each at the
/// first place of a uniform random sequence where it touches neither the wall nor an earlier sphere. They fill the
/// space evenly at `solid_fraction` up to some height, without a lattice. Returns the centres in the order of the
/// radii. Pure function.
///
/// Requirements: 0 < solid_fraction, well below 0.38, the saturation of equal spheres; above it they are placed higher
/// up. The largest sphere fits into the hopper.
std::vector<Vec3> random_addition(const Mould& mould, const std::vector<double>& radii, double solid_fraction,
                                  std::uint64_t seed);

}  // namespace pastefit
