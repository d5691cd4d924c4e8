#pragma once

#include <charconv>
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

/// A number with the fewest digits that are read back as the same one: 0.3, where %.17g says 0.29999999999999999.
inline std::string exact(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

}  // namespace pastefit
