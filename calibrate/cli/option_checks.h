#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>

namespace pastefit {

/// Checks of the number behind an option, before it is read: no more and no less than a finite number in its range. The
/// fault says what stands there, cut if long, and what would be right.

/// Above 0, and no more than anyone could wait for or look at: 1e9.
CLI::Validator positive_number();

/// From `smallest` to `largest`.
CLI::Validator number_from(double smallest, double largest);

/// A whole number without sign, from `smallest` to `largest`.
CLI::Validator whole_number(std::uint64_t smallest = 0,
                            std::uint64_t largest = std::numeric_limits<std::uint64_t>::max());

}  // namespace pastefit
