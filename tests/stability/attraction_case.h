#pragma once

#include <vector>

#include "tests/stability/stress_case.h"

namespace pastefit {

/// Number of cases on the grid of the attraction; the grid is run through again and again with other draws.
int attraction_grid();

/// The cases `first` .. `first + count - 1` of a grid over the attraction's own ratios, in a Hägermann cone lifted in
/// 0.2 s: `cohesion_ratio` over its range, and `mould_cohesion_factor` and `table_cohesion_factor` over theirs, each
/// for three strengths and three sizes of grains. All other parameters and the laws are drawn, `parameter_kinds` within
/// what a study usually searches. A pure function of its arguments.
///
/// A run has to end with readings or be refused because its grains are too soft; energy created is a defect.
std::vector<StressCase> attraction_cases(int first, int count, std::uint64_t seed);

}  // namespace pastefit
