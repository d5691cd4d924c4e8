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

/// The same of a text that a person may paste: as it is, where no shell reads anything into it.
inline std::string shell_word_if_needed(std::string_view text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+,:@-";
  const bool as_it_is = !text.empty() && text[0] != '-' && text.find_first_not_of(plain) == std::string_view::npos;
  return as_it_is ? std::string(text) : shell_word(text);
}

}  // namespace pastefit
