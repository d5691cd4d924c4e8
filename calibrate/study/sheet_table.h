#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/study/slump_sheet.h"
#include "core/result.h"

namespace pastefit {

/// A row of a laboratory's table.
struct SheetRow {
  std::string name;      ///< of the sample, fit for a folder: small letters, digits and -
  std::size_t line = 0;  ///< of the table
  Sheet sheet;
};

/// A laboratory's table of slump tests.
struct SheetTable {
  std::vector<SheetRow> rows;
  std::vector<std::string> mix;         ///< heads of columns that belong to the mix
  std::vector<std::string> unused;      ///< heads of columns that name nothing of a sheet
  std::vector<std::size_t> without;     ///< lines without a reading
  std::vector<std::size_t> statistics;  ///< lines of means and the like
};

/// The samples of a table of values between commas, semicolons or tabs (RFC 4180), a row each. Its head has the names
/// of the options of `pastefit new`, or those of the standards in English or German, with their units: "slump (mm)",
/// "Slump 2, in", "Rohdichte [kg/dm3]"; columns of one name with numbers behind it are repeats. A column in kg/m3 that
/// names nothing else is one of the mix. Lines above the head are for people; a line below it may hold the units. Text
/// in UTF-8, in UTF-16 with its byte order mark, or else in Windows' code page 1252; between semicolons and tabs a
/// comma between digits is a decimal one. What the table has no column for is as in `defaults`, and so are a mould and
/// a density that a row does not say.
///
/// Faults: no head, no row with a reading, a head or cell that cannot be understood, a sample twice; all by their
/// place.
SheetTable sheet_table(std::string_view bytes, const Sheet& defaults, Faults& faults);

/// The same of a file, which each sheet names as its source.
SheetTable read_sheet_table(const std::filesystem::path& file, const Sheet& defaults, Faults& faults);

}  // namespace pastefit
