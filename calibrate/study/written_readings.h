#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// Parses "180, 175, 190 mm" or "7 1/4 in" in the unit of the key: numbers separated by commas with a space, by
/// semicolons or by spaces; a unit at the end applies to all. Errors: not a number, with a suggestion; a comma without
/// a space; a unit of another quantity, or of some numbers only.
Result<std::vector<double>> written_readings(const std::string& where, const std::string& text, std::string_view unit);

/// Replaces "percent" and "per cent" by "%".
std::string with_percent_sign(const std::string& text);

}  // namespace pastefit
