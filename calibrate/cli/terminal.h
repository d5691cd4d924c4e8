#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pastefit {

/// Whether standard error is a terminal in which a line can be rewritten.
bool is_terminal();

/// The columns of a line on standard error: of the terminal's window, 80 where there is none.
std::size_t columns();

/// A message as it is written to standard error: on a terminal its lines are broken between words.
std::string for_terminal(const std::string& text);

/// As many of the parts, joined by commas, as fit on a line; the first one always, cut if need be.
std::string fitted(const std::vector<std::string>& parts);

/// A time to wait, from `least_s` to `most_s`, in words: "40 s to 3 min".
std::string range_of_time(double least_s, double most_s);

}  // namespace pastefit
