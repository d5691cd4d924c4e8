#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/result.h"

namespace pastefit {

/// What stands in place of a key that no description names; such a fault leaves the other values as they are.
inline constexpr std::string_view unknown_key = "unknown key";

/// Puts the file's name before the place of each fault: "mix.json: measurements.step1.height_mm"; nothing, if it has
/// none.
Faults in_file(Faults faults, const std::filesystem::path& file);

/// One message that lists every fault, one a line: "place: what; remedy".
std::string message_of(const Faults& faults);

/// A number as it is shown to people, at most six digits.
std::string shown(double number);

/// The candidate with the smallest edit distance to `word`, if it is near enough to be a slip of the pen.
std::optional<std::string> nearest(std::string_view word, const std::set<std::string, std::less<>>& candidates);

/// A word of the user's in quotes, cut if long; control characters, which could drive a terminal, are escaped.
std::string in_quotes(std::string_view text);

/// The same without quotes, for a key as part of a place.
std::string printable(std::string_view text);

/// The path of a key in an object at `place`, which is empty for the document itself.
std::string joined(const std::string& place, std::string_view key);

}  // namespace pastefit
