#pragma once

#include <iosfwd>
#include <vector>

#include "tests/bench/ladder.h"

namespace pastefit {

/// One row per run.
void write_csv(std::ostream& csv, const std::vector<Row>& rows);

/// The runs that a file written by the above has of a setting, by packing; no more than the setting asks for.
std::vector<Run> read_csv(std::istream& csv, const Setting& setting);

}  // namespace pastefit
