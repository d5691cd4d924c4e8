#pragma once

#include "calibrate/study/study.h"
#include "core/result.h"

namespace pastefit {

/// What a simulation of the test needs at its peak [bytes]: 1 kB for each grain (a settled box of
/// 100,000 to 1,000,000 grains takes 750 to 1000, see tests/bench/speed/README.md).
double memory_needed_bytes(const Test& test);

/// Why so many simulations of the test at a time do not fit into the memory; empty: they do. 0: one on each processor.
/// Requirement: `validate(test)` is empty.
Faults validate_memory(const Test& test, int at_once);
Faults validate_memory(const Study& study, int at_once);

/// Steps that a simulation of the test takes at least: the time in which its apparatus moves, and a second to fill it
/// and to rest, at a tenth of the collision of two of its grains at 1 m/s (a mould of 14 mm grains took 1.9 times as
/// many). With a fixed step as many as that says.
double least_steps(const Test& test, std::optional<double> fixed_step_s = std::nullopt);

/// Processor time that it takes at least [s]: its grains times its steps, at the fastest that was measured, 20 million
/// particle-steps a second (tests/bench/speed/README.md).
double least_effort_s(const Test& test, std::optional<double> fixed_step_s = std::nullopt);

/// Of every test that is fitted, in as many simulations as the study's budget.
double least_effort_s(const Study& study);

}  // namespace pastefit
