#pragma once

#include <cstdint>
#include <span>

#include "calibrate/optimisers/problem.h"
#include "calibrate/search/objective.h"

namespace pastefit {

/// The misfit, and the residuals, of candidates on these packings as a problem for an optimiser.
/// `goal`: a feasible miss at or below it is good enough; 0: none is. Requirements: packings are given; `objective` and
/// `packings` outlive the problem. Refuses when a stop is requested, and what the objective's budget does not allow.
Problem simulated_problem(Objective& objective, std::span<const std::uint64_t> packings, double goal = 0);

}  // namespace pastefit
