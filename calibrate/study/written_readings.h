#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// "180, 175, 190 mm" in the unit of the key, also "7 1/4 in": numbers between commas with a space, semicolons or
/// spaces; a unit at the end is that of all. Error: what is no number, with what may have been meant; a comma without a
/// space, a unit of something else, or of some numbers only.
Result<std::vector<double>> written_readings(const std::string& where, const std::string& text, std::string_view unit);

/// The text with "%" for "percent" and "per cent".
std::string with_percent_sign(const std::string& text);

}  // namespace pastefit
