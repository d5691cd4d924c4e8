#pragma once

#include <iosfwd>
#include <map>

#include "tests/twins/twin.h"

namespace pastefit {

/// One row per twin. The head names the free parameters, so it is the same for all twins of a study.
void write_head(std::ostream& csv, const Study& study);
void write_row(std::ostream& csv, const TwinResult& result);

/// The rows of a file written by the two above, by number; a last one that was cut off is left out.
std::map<int, TwinResult> read_table(std::istream& csv);

/// What the rows add up to, in Markdown: the shares that a calibration with honest intervals has to reach.
void write_report(std::ostream& out, const std::vector<TwinResult>& results, const std::string& title);

}  // namespace pastefit
