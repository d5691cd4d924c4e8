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

/// A point of a study in one of its tests on some packings, in their order; fewer, if the user does not want to wait.
using SimulatePoint = std::function<std::vector<StoredEvaluation>(
    const Study& study, const UnitPoint& point, std::span<const std::uint64_t> packings, std::size_t test)>;

/// What each unstated condition of a study does to the readings of a material at the ends of its range, as long as
/// there are simulations left and the user waits. Requirement: at least one packing.
std::vector<ConditionEffect> condition_effects(const Study& study, const UnitPoint& material,
                                               std::span<const std::uint64_t> packings, int simulations,
                                               const SimulatePoint& simulate);

}  // namespace pastefit
