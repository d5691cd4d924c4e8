#pragma once

#include <string_view>

namespace pastefit {

/// Meaning of a reading by its key in laboratory files; empty if unknown.
std::string_view meaning_of_reading(std::string_view key);

}  // namespace pastefit
