#pragma once

#include <cstdint>
#include <vector>

#include "calibrate/search/objective.h"

namespace pastefit {

/// A well-mixed 64-bit number from a seed and a counter; the same on every machine.
/// Source: the finaliser of SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).
std::uint64_t hash_of(std::uint64_t seed, std::uint64_t counter);

/// Space-filling points of the unit cube: a Sobol sequence without its first point (the corner 0), each coordinate
/// shifted by a number drawn from `seed` and wrapped (Cranley & Patterson 1976). Seed 0: no shift.
/// Requirements: dimension >= 1, count >= 0. Shapes: count points of `dimension` coordinates, each in [0, 1).
std::vector<UnitPoint> screening_points(int dimension, int count, std::uint64_t seed);

}  // namespace pastefit
