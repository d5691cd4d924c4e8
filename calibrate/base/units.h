#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace pastefit {

inline constexpr double mm = 1000;                         ///< millimetres per metre
inline constexpr double degrees = 180 / std::numbers::pi;  ///< degrees per radian

/// Unit in user texts, and the unit of the same quantity in the keys of pastefit's files.
struct Unit {
  std::string_view name;  ///< as written: "lb/ft3"
  std::string_view key;   ///< end of a key, without the underscore: "kg_m3"
  double factor = 1;      ///< value in the key's unit
};

/// Unit for a word in any common spelling ("in", "inches", "lbs/ft^3", "kg_l"); nothing if unknown.
std::optional<Unit> unit_of_word(std::string_view word);

/// Unit at the end of a key: "slump_in" is in inches; nothing if there is none.
std::optional<Unit> unit_of_key(std::string_view key);

/// Unit of the number at a place in a file, from its key or, for "value" etc., from the key of the enclosing object:
/// "measurements.step1.height_mm.repeats[2]" is in mm. Nothing if there is none.
std::optional<Unit> unit_of_place(std::string_view place);

/// Conversions of a number in other units that lie between `smallest` and `largest` (in the key's unit): "33 cm are 330
/// mm, 33 in are 838.2 mm". Empty if there are none.
std::string in_other_units(double number, std::string_view key_unit, double smallest, double largest);

/// Number as typed, with or without unit, with decimal point or comma ("7.25 in", "162,5").
struct WrittenNumber {
  double value = 0;
  std::optional<Unit> unit;
  bool comma = false;  ///< has a decimal comma
};

/// Parses a typed number; nothing if it is invalid or its unit unknown.
std::optional<WrittenNumber> written_number(std::string_view text);

/// Parses "180, 175, 190 mm" or "7 1/4 in" in the unit of the key: numbers separated by commas with a space, by
/// semicolons or by spaces; a unit at the end applies to all. Errors: not a number, with a suggestion; a comma without
/// a space; a unit of another quantity, or of some numbers only.
Result<std::vector<double>> written_readings(const std::string& where, const std::string& text, std::string_view unit);

/// Replaces "percent" and "per cent" by "%".
std::string with_percent_sign(const std::string& text);

}  // namespace pastefit
