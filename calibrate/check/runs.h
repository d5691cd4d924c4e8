#pragma once

#include <cstdint>
#include <vector>

#include "calibrate/check/check.h"

namespace pastefit {

/// Simulates `test` in each packing, in parallel; outcomes in their order.
std::vector<Outcome> outcomes_of(const Test& test, const std::vector<std::uint64_t>& packings,
                                 const CheckEngine& engine, int threads);

/// Message of a failure: "packing 7: failed (never_settled in step1)".
Fault failure_in(std::uint64_t packing, const Failure& failure, const std::string& heading = "");

/// Their readings. `heading`: prefix of faults (`heading_of`).
/// Errors: a simulation fails.
Result<std::vector<Baseline::Run>> baseline_runs(const Test& test, const std::string& heading,
                                                 const std::vector<std::uint64_t>& packings, const CheckEngine& engine,
                                                 int threads);

}  // namespace pastefit
