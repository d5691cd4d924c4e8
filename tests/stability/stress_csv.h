#pragma once

#include <iosfwd>
#include <map>

#include "tests/stability/stress_report.h"

namespace pastefit {

/// One row per run: number of the case, its inputs, how it ended.
void write_csv_head(std::ostream& csv, const StressCase& any);
void write_csv_row(std::ostream& csv, const StressResult& result);

/// The verdicts of a file written by the two above, by the number of their case. Rows that are incomplete, as the last
/// one of a campaign that was killed may be, are left out.
std::map<int, StressVerdict> read_csv(std::istream& csv);

}  // namespace pastefit
