#pragma once

#include <cstdint>
#include <vector>

#include "calibrate/check/check.h"

namespace pastefit {

/// Runs `test` in each packing; in parallel, answers in order. `heading`: what a fault begins with (`heading_of`).
/// Error: a simulation fails.
Result<std::vector<Baseline::Run>> baseline_runs(const Test& test, const std::string& heading,
                                                 const std::vector<std::uint64_t>& packings, const CheckEngine& engine,
                                                 int threads);

/// The runs that a laboratory would accept (`laboratory/test.h`).
std::vector<Baseline::Run> accepted(const Test& test, const std::vector<Baseline::Run>& runs);

/// The values of one reading, in the order of the runs.
std::vector<double> column_of(const std::vector<Baseline::Run>& runs, const std::string& name);

}  // namespace pastefit
