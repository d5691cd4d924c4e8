#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/result.h"

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

/// The number with so many digits, as JSON then writes it: a point that is drawn needs no more.
inline double rounded(double value, int digits = 5) {
  return std::strtod(format("%.*g", digits, value).c_str(), nullptr);
}

/// The number with so many digits as people write it: "11900", where printf has "1.19e+04".
inline std::string plain(double value, int digits = 3) {
  return format("%.9g", rounded(value, digits));
}

inline constexpr std::size_t kColumns = 80;

/// Text for people with its lines broken between words, so that none is longer than so many columns; a word that is
/// longer by itself, as a path is, stays whole, and a number stays beside its error and its percent sign. What goes on
/// stands below the second column of a table's row, else two columns in from its line.
std::string wrapped(std::string_view text, std::size_t columns = kColumns);

/// What stands in place of a key that no description names; such a fault leaves the other values as they are.
inline constexpr std::string_view unknown_key = "unknown key";

/// Puts the file's name before the place of each fault: "mix.json: measurements.step1.height_mm"; nothing, if it has
/// none.
Faults in_file(Faults faults, const std::filesystem::path& file);

/// One message that lists every fault, one a line: "place: what; remedy".
std::string message_of(const Faults& faults);

/// A number as it is shown to people, at most six digits.
inline std::string shown(double number) {
  return format("%.6g", number);
}

/// The text in small letters, as far as they are ASCII.
std::string small_letters(std::string_view text);

/// The candidate with the smallest edit distance to `word`, whatever the case of its letters, if it is near enough to
/// be a slip of the pen.
std::optional<std::string> nearest(std::string_view word, const std::set<std::string, std::less<>>& candidates);

/// A word of the user's in quotes, cut if long; control characters, which could drive a terminal, are escaped.
std::string in_quotes(std::string_view text);

/// The same without quotes, for a key as part of a place.
std::string printable(std::string_view text);

/// The path of a key in an object at `place`, which is empty for the document itself.
std::string joined(const std::string& place, std::string_view key);

/// Texts that somebody else wrote (a title, a note, the name of a file), made fit for the place they are written to.
/// Every such text goes through the function of its target. All of them answer with valid UTF-8, in which bytes that
/// are none are U+FFFD, and control characters, which could drive a terminal or turn the order of its letters round,
/// are spaces.

/// For people, as part of a line.
std::string one_line(std::string_view text);

/// For people, as it is: line breaks and tabs stay.
std::string lines_of(std::string_view text);

/// A comment of one line, "# ...\n", in the decks of LAMMPS and LIGGGHTS and in a Python module: what their readers
/// look for in comments too (quotation marks, variables, continued lines) is replaced. Python reads its encoding from
/// comments of the first two lines: such a comment has to stand further down.
std::string deck_comment(std::string_view text);

/// Content or an attribute of XML; a line break in it is a character reference.
std::string xml_text(std::string_view text);

/// JSON with indentation, ending with a line break; control characters are escaped.
std::string json_text(const nlohmann::ordered_json& value);

/// JSON on one line to stand in an element of HTML, a script's too: no text in it can end the element or begin another,
/// because "<", ">" and "&" are written as escapes, like all that is not ASCII.
std::string json_in_html(const nlohmann::ordered_json& value);

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

/// Bytes as text of 64 letters, four for each three bytes, the last ones filled up with "=" (RFC 4648).
std::string base64(std::string_view bytes);

/// FNV-1a, 64 bits, as 16 hexadecimal digits. Tells contents apart; no protection against intent.
/// Source: Fowler, Noll & Vo; offset basis 0xcbf29ce484222325, prime 0x100000001b3.
inline std::string content_hash(std::string_view content) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : content) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3u;
  }
  std::string digits(16, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, hash >>= 4)
    *digit = "0123456789abcdef"[hash & 15];
  return digits;
}

}  // namespace pastefit
