#pragma once

#include <cstdint>
#include <vector>

#include "core/apparatus/slump/slump_test.h"
#include "core/vec3.h"

namespace pastefit {

/// Inner radius at height z of the mould with a straight hopper on top of it, as high as is needed [m].
double inner_radius(const Mould& mould, double z);

/// Random sequential addition (Widom 1966): spheres of these radii are put into mould and hopper one after the other,
/// each at the first place of an even random sequence at which it touches neither the wall nor an earlier one. They
/// fill mould and hopper evenly, at `solid_fraction`, up to some height; they remember no lattice. Returns the centres,
/// in the order of the radii. Pure function of its arguments.
///
/// Requirements: 0 < solid_fraction, well below the 0.38 at which no equal sphere finds a place any more; beyond that
/// they are put higher up. The largest sphere fits into the hopper.
std::vector<Vec3> random_addition(const Mould& mould, const std::vector<double>& radii, double solid_fraction,
                                  std::uint64_t seed);

}  // namespace pastefit
