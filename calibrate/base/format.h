#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace pastefit {

/// A text by printf's rules. Numbers and C strings only.
template <class... Values>
std::string format(const char* pattern, Values... values) {
  const int length = std::snprintf(nullptr, 0, pattern, values...);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, ' ');
  std::snprintf(text.data(), text.size() + 1, pattern, values...);
  return text;
}

}  // namespace pastefit
