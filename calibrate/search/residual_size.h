#pragma once

#include "core/result.h"

namespace pastefit {

struct Measurement;
struct Study;

/// By how many worst misses a failed candidate is off at most (`SimulationObjective`).
inline constexpr double worst_factor = 3;

/// The largest error a heap can have, in the measurement's unit. Requirement: `test` is an index of `study.tests`.
double worst_miss(const Study& study, std::size_t test, const Measurement& measurement);

/// Every prior and every fitted reading whose residual, or its square, is not finite somewhere between the bounds,
/// places as in study and laboratory files. A study that was read has none (its numbers have ranges); one that a
/// program put together may.
Faults validate_residuals(const Study& study);

}  // namespace pastefit
