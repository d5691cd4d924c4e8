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

}  // namespace pastefit
