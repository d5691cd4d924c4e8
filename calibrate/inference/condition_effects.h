#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "calibrate/optimisers/problem.h"
#include "calibrate/store/store.h"
#include "calibrate/study/unstated_conditions.h"

namespace pastefit {

/// Packings on which a material is simulated at either end of a condition's range.
inline constexpr std::size_t condition_packings = 2;

/// Simulates a point of a study in one of its tests, on these packings and in their order; fewer after a stop request.
using SimulatePoint = std::function<std::vector<StoredEvaluation>(
    const Study& study, const UnitPoint& point, std::span<const std::uint64_t> packings, std::size_t test)>;

/// Readings of a material at both ends of the range of each unstated condition, as long as there are simulations left
/// and no stop is requested. Requirement: at least one packing.
std::vector<ConditionEffect> condition_effects(const Study& study, const UnitPoint& material,
                                               std::span<const std::uint64_t> packings, int simulations,
                                               const SimulatePoint& simulate);

}  // namespace pastefit
