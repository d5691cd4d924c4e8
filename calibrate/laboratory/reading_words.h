#pragma once

#include <string_view>

namespace pastefit {

/// What a reading of laboratory files is, by its key there; empty if there is none.
std::string_view meaning_of_reading(std::string_view key);

}  // namespace pastefit
