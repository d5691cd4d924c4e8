#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pastefit {

inline constexpr std::size_t kColumns = 80;

/// Text for people with its lines broken between words, so that none is longer than so many columns; a word that is
/// longer by itself, as a path is, stays whole, and a number stays beside its error and its percent sign. What goes on
/// stands below the second column of a table's row, else two columns in from its line.
std::string wrapped(std::string_view text, std::size_t columns = kColumns);

}  // namespace pastefit
