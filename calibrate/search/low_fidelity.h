#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "calibrate/evaluate/objective.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// First packing seed of coarse grains: its simulations can lie in one store with those of the study.
inline constexpr std::uint64_t coarse_packings = 1ULL << 40;

/// The packings of coarse grains: the same for every candidate.
std::vector<std::uint64_t> packings_of_coarse(std::uint64_t seed, int count);

/// What coarse simulations say of fine ones: each feasible one, its residuals moved by the bias between the rungs,
///     bias = mean over the feasible fine simulations of (their residuals - coarse surrogate at their point),
/// one for each reading. The search tries every candidate with coarse grains before it does with the study's own, so
/// the surrogate is read where it knows. 0 as long as there is no fine simulation. Limits: one bias for all candidates;
/// the fine simulations gather about the target, so it is the bias there. Requirements: `coarse` and `fine` are
/// simulations on one packing each, with residuals of the same weights.
std::vector<Response> corrected(std::span<const Response> coarse, std::span<const Response> fine);

}  // namespace pastefit
