#pragma once

#include <string>
#include <vector>

#include "calibrate/search/comparison.h"

namespace pastefit {

/// A drawing (SVG) of misfit against simulations, one line for each strategy in the order of the rows, the first five
/// and "default" in colour, and what is asked for as a level; in `unit`.
std::string misfit_figure(const std::vector<StrategySummary>& rows, const ErrorUnit& unit, const std::string& title);

}  // namespace pastefit
