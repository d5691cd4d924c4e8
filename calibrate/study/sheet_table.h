#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/study/slump_sheet.h"
#include "core/result.h"

namespace pastefit {

/// A row of a laboratory's table.
struct SheetRow {
  std::string name;      ///< of the sample, usable as folder name: small letters, digits and -
  std::size_t line = 0;  ///< of the table
  Sheet sheet;
};

/// Table of slump tests.
struct SheetTable {
  std::vector<SheetRow> rows;
  std::vector<std::string> mix;         ///< headings of mix variables
  std::vector<std::string> unused;      ///< headings of unused columns
  std::vector<std::size_t> without;     ///< lines without a reading
  std::vector<std::size_t> statistics;  ///< lines of statistics, e.g. means
};

/// Parses a table of values separated by commas, semicolons or tabs (RFC 4180), one sample per row.
/// Headings are option names of `pastefit new`, or names from the standards in English or German, with units: "slump
/// (mm)", "Slump 2, in", "Rohdichte [kg/dm3]". Columns of one name with trailing numbers are repeats; an otherwise
/// unknown column in kg/m3 is a mix variable. Lines above the header are ignored; the line below it may contain units.
/// Encoding: UTF-8, UTF-16 with byte order mark, otherwise Windows code page 1252. If semicolons or tabs separate, a
/// comma between digits is a decimal comma. `defaults` provides what the table has no column for, and mould and density
/// of rows without them.
/// Faults, each with its place: no header, no row with a reading, an unreadable heading or cell, a duplicate sample.
SheetTable sheet_table(std::string_view bytes, const Sheet& defaults, Faults& faults);

}  // namespace pastefit
