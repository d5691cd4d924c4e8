#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "calibrate/evaluate/response.h"
#include "calibrate/study/study.h"

namespace pastefit {

/// First packing seed of coarse grains; distinct from the study's, so that both can share one store.
inline constexpr std::uint64_t coarse_packings = 1ULL << 40;

/// Packings of coarse grains, the same for every candidate.
std::vector<std::uint64_t> packings_of_coarse(std::uint64_t seed, int count);

/// Coarse simulations as predictions of fine ones: the feasible ones with their residuals shifted by
///     bias = mean over the feasible fine simulations of (their residuals - coarse surrogate at their point),
/// one for each reading; 0 without fine simulations. Requirements: `coarse` and `fine` are on one packing each, with
/// equally weighted residuals. Because the search simulates every candidate with coarse grains first, the surrogate has
/// data at the fine points. Limit: all candidates get the same bias, that near the target, where the fine simulations
/// concentrate.
std::vector<Response> corrected(std::span<const Response> coarse, std::span<const Response> fine);

}  // namespace pastefit
