#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace pastefit {

inline constexpr double mm = 1000;                         ///< millimetres in a metre
inline constexpr double degrees = 180 / std::numbers::pi;  ///< in a radian

/// A unit that people write, and the one of the keys of pastefit's files for the same quantity.
struct Unit {
  std::string_view name;  ///< as people write it: "lb/ft3"
  std::string_view key;   ///< the end of a key, without its underscore: "kg_m3"
  double factor = 1;      ///< one of it in the key's unit
};

/// The unit that a word names, in any usual spelling ("in", "inches", "lbs/ft^3", "kg_l"). Nothing if it is none.
std::optional<Unit> unit_of_word(std::string_view word);

/// The unit at the end of a key: "slump_in" has inches. Nothing if the key ends with none.
std::optional<Unit> unit_of_key(std::string_view key);

/// The unit of the number at a place in a file, from its key or, of "value" and the like, from that of the object it
/// stands in: "measurements.step1.height_mm.repeats[2]" is in mm. Nothing where it has none.
std::optional<Unit> unit_of_place(std::string_view place);

/// "33 cm are 330 mm, 33 in are 838.2 mm": what the number would be in other units, as far as that lies in the range
/// from `smallest` to `largest`, which are in the unit of the key. Empty if there is none.
std::string in_other_units(double number, std::string_view key_unit, double smallest, double largest);

/// A number as people write it: with its unit or without, with a decimal point or comma ("7.25 in", "162,5").
struct WrittenNumber {
  double value = 0;
  std::optional<Unit> unit;
  bool comma = false;  ///< written with a decimal comma
};

/// Nothing if the text is no such number, or has a unit that is not known.
std::optional<WrittenNumber> written_number(std::string_view text);

}  // namespace pastefit
