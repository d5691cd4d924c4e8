#pragma once

#include <span>
#include <vector>

#include "calibrate/store/store.h"
#include "calibrate/study/unstated_conditions.h"

namespace pastefit {

/// Packings simulated at each end of a condition's range.
inline constexpr std::size_t condition_packings = 2;

/// Unstated conditions, in order, as long as the simulations suffice for both ends of the range in every test; they are
/// taken from `simulations`.
std::vector<UnstatedCondition> affordable_conditions(const Study& study, std::size_t packings, int& simulations);

/// Effect of a condition. `lower`, `upper`: runs of a material at both ends of the range, test by test, each on the
/// same packings.
ConditionEffect effect_of(const Study& study, const UnstatedCondition& condition,
                          std::span<const StoredEvaluation> lower, std::span<const StoredEvaluation> upper);

}  // namespace pastefit
