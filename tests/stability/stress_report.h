#pragma once

#include <ostream>
#include <vector>

#include "tests/stability/verdict.h"

namespace pastefit {

/// A case and how it ended.
struct StressResult {
  StressCase stress;
  StressVerdict verdict;
};

/// Markdown: ends in all; ends by region of the box (rows: ranges; columns: ends); failures by reason and phase with a
/// case to repeat each; the energy balance and the cost of the runs; defects with their numbers.
void write_report(std::ostream& out, const std::vector<StressResult>& results);

}  // namespace pastefit
