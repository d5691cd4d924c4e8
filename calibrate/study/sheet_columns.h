#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/input_file.h"
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

}  // namespace pastefit
