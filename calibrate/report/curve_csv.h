#pragma once

#include <optional>
#include <string>

#include "calibrate/card/card.h"
#include "calibrate/report/views.h"

namespace pastefit {

/// What a test draws (`Curve`), over the runs of its view, as CSV: one line for each point, below the names of the
/// columns. These are the curve's own x and y, y the mean over the runs; the lowest and the highest of them; and each
/// reading that the laboratory took in the unit of y, e.g. a strength in Pa beside a stress, with its standard
/// deviation, the same in every line. Nothing where no run has a curve.
std::optional<std::string> curve_csv(const CardTest& test, const TestView& view);

/// Its file in a calibration's folder: curve.csv, or curve-NAME.csv of a test that has a name.
std::string curve_file(const std::string& test_name);

}  // namespace pastefit
