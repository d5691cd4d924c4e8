#pragma once

#include "calibrate/study/study.h"
#include "core/result.h"

namespace pastefit {

/// Errors if `at_once` simulations of the test exceed the available memory; empty if they fit. 0: one on each
/// processor. Requirement: `validate(test)` is empty.
Faults validate_memory(const Test& test, int at_once);
Faults validate_memory(const Study& study, int at_once);

/// Smallest number of steps of a simulation: the time in which the apparatus moves, plus 1 s to fill and to rest, over
/// a tenth of the collision time of two grains at 1 m/s (a mould of 14 mm grains took 1.9 times as many), or over the
/// fixed step if given.
double least_steps(const Test& test, std::optional<double> fixed_step_s = std::nullopt);

/// Smallest processor time of a simulation [s]: grains times steps at the highest measured speed, 20 million
/// particle-steps a second (tests/bench/speed/README.md).
double least_effort_s(const Test& test, std::optional<double> fixed_step_s = std::nullopt);

/// The same for all fitted tests and the study's budget of simulations [s].
double least_effort_s(const Study& study);

}  // namespace pastefit
