#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/input_file.h"
#include "calibrate/study/slump_sheet.h"
#include "core/result.h"

namespace pastefit {

/// Meanings of columns other than readings; those have the option name of `pastefit new`.
inline constexpr std::string_view kIsSample = "sample", kIsTitle = "title", kIsMould = "mould", kIsDensity = "density",
                                  kIsDrops = "drops", kIsYieldStress = "yield-stress";

inline constexpr std::size_t most_columns = 300, longest_cell = 500;  // std::regex recurses with the length

/// Converts to small letters without umlauts; anything but letters and digits becomes a blank.
std::string folded(std::string_view text);

/// Column of a laboratory's table: an option of `pastefit new` (`is`) or a mix variable (`mix`); both are empty if
/// unused.
struct SheetColumn {
  std::string head;
  std::string says;  ///< the head without its unit, folded
  std::string is, mix;
  std::string unit;

  bool known() const { return !is.empty() || !mix.empty(); }
  /// Takes the unit from the heading or the line below. An otherwise unknown quantity in kg/m3 that is no density
  /// becomes a mix variable.
  void take_unit(const std::string& word);
};

/// Parses the first `most_columns` columns of a header line. Headings are option names of `pastefit new`, or names from
/// the standards in English or German, with a unit; trailing numbers count repeats.
std::vector<SheetColumn> sheet_columns(const CsvLine& line);

/// True if any column is a reading.
bool names_reading(std::span<const SheetColumn> columns);

/// Faults of headings: unknown units, duplicates, numbers of unclear meaning.
Faults faults_of_heads(std::span<const SheetColumn> columns);

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
