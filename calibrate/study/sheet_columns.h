#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/base/input_file.h"
#include "core/result.h"

namespace pastefit {

/// What a column is, besides a reading by the name of its option in `pastefit new`.
inline constexpr std::string_view kIsSample = "sample", kIsTitle = "title", kIsMould = "mould", kIsDensity = "density",
                                  kIsDrops = "drops", kIsYieldStress = "yield-stress";

inline constexpr std::size_t most_columns = 300, longest_cell = 500;  // std::regex recurses with the length

/// In small letters without umlauts, with a blank for what is no letter and no digit.
std::string folded(std::string_view text);

/// A column of a laboratory's table: what it is in `pastefit new`, or a variable of the mix; neither of one that is not
/// used.
struct SheetColumn {
  std::string head;
  std::string says;  ///< the head without its unit, folded
  std::string is, mix;
  std::string unit;

  bool known() const { return !is.empty() || !mix.empty(); }
  /// Takes the unit of the head or of the line below. A quantity in kg/m3 that is nothing else, and no density, is a
  /// variable of the mix.
  void take_unit(const std::string& word);
};

/// The first `most_columns` columns of a line, as its cells name them: by the names of the options of `pastefit new`,
/// or by those of the standards in English or German, with a unit. Numbers behind names count repeats.
std::vector<SheetColumn> sheet_columns(const CsvLine& line);

/// Whether some column is a reading.
bool names_reading(std::span<const SheetColumn> columns);

/// Heads with an unknown unit, those that say what another says, and numbers of which it is open what they count.
Faults faults_of_heads(std::span<const SheetColumn> columns);

}  // namespace pastefit
