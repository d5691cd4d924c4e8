#pragma once

#include <ostream>
#include <vector>

#include "tests/bench/ladder.h"

namespace pastefit {

/// The front as an SVG picture: processor time of a run (logarithmic) against the error of a reading, one panel for
/// each scene and ladder. Bars are twice the noise of the difference; hollow points lie within it.
void write_figure(std::ostream& out, const std::vector<Row>& rows, std::size_t reading);

}  // namespace pastefit
