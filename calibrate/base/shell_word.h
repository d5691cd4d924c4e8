#pragma once

#include <string>
#include <string_view>

namespace pastefit {

/// The text as one word of a shell, in single quotes.
inline std::string shell_word(std::string_view text) {
  std::string out = "'";
  for (const char letter : text) {
    if (letter == '\'')
      out += "'\\''";
    else
      out += letter;
  }
  return out + "'";
}

}  // namespace pastefit
