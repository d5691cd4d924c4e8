#pragma once

#include <optional>

#include "calibrate/laboratory/test.h"

namespace pastefit {

/// The failure that a test comes to without being simulated: grains that are so soft that their own attraction presses
/// two of them deeper into each other than `RunOptions` lets any be. A search asks before it prepares a candidate: what
/// is poured is smaller the softer it is, without end, and a mould of it has no end either.
std::optional<Failure> too_soft(const Test& test, const RunOptions& options);

}  // namespace pastefit
