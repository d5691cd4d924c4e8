#pragma once

#include <vector>

#include "tests/stability/stress_case.h"

namespace pastefit {

/// Number of corners of the box of the parameters; they have the first numbers, random points follow.
constexpr int kParameterCorners = 512;

/// The cases `first` .. `first + count - 1` of the box that a study may search (`parameter_kinds`), on the cheapest
/// scene: some sixty grains in a Hägermann cone, lifted in 0.2 s. A pure function of its arguments.
///
/// Corners: of the 2^20 an orthogonal array of strength 4, so that every combination of the ends of any four parameters
/// occurs, equally often. Others: drawn evenly, on the logarithm where a parameter's scale is logarithmic. The laws
/// (normal, attraction, formation, rolling, basis of friction) are drawn for each.
/// Not every case is admissible: grains too soft for their attraction are refused by `validate`.
std::vector<StressCase> parameter_cases(int first, int count, std::uint64_t seed);

}  // namespace pastefit
