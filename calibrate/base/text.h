#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iterator>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/result.h"

namespace pastefit {

/// The value as printf takes it.
auto for_printf(const auto& value) {
  return value;
}
inline const char* for_printf(const std::string& text) {
  return text.c_str();
}

/// printf-formatted text of numbers, C strings and strings.
template <class... Values>
std::string format(const char* pattern, const Values&... values) {
  const int length = std::snprintf(nullptr, 0, pattern, for_printf(values)...);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, ' ');
  std::snprintf(text.data(), text.size() + 1, pattern, for_printf(values)...);
  return text;
}

/// Shortest decimal number with the same value: 0.3, where %.17g gives 0.29999999999999999.
inline std::string exact(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

/// The number that a whole text is; nothing for other texts, and for numbers beyond the type's range.
template <class Number>
std::optional<Number> parsed_number(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Rounds to significant digits, which shortens the JSON of drawn points.
inline double rounded(double value, int digits = 5) {
  return std::strtod(format("%.*g", digits, value).c_str(), nullptr);
}

/// Number with `digits` significant digits without exponent: "11900", where printf gives "1.19e+04".
inline std::string plain(double value, int digits = 3) {
  return format("%.9g", rounded(value, digits));
}

/// Breaks lines between words at `columns`. Longer words, e.g. paths, stay whole; a number stays with its error and
/// percent sign. Continuation lines start at the second column of a table row, otherwise two columns to the right.
std::string wrapped(std::string_view text, std::size_t columns = 80);

/// `what` of the fault of an unknown key, which does not affect other values.
inline constexpr std::string_view unknown_key = "unknown key";

/// Collects faults, to report all of them together.
inline void append(Faults& faults, Faults more) {
  faults.insert(faults.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// The value of a result, or nothing after collecting its faults.
template <class T>
std::optional<T> value_or_append(Result<T> result, Faults& faults) {
  if (result.ok()) return std::move(result).value();
  append(faults, result.faults());
  return std::nullopt;
}

/// Prefixes the place of each fault with the file name: "mix.json: measurements.step1.height_mm"; unchanged without a
/// name.
Faults in_file(Faults faults, const std::filesystem::path& file);

/// Message with one line per fault: "place: what; remedy".
std::string message_of(const Faults& faults);

/// Number for display, at most six digits.
inline std::string shown(double number) {
  return format("%.6g", number);
}

/// Removes the first line and returns it, without its line break.
std::string_view next_line(std::string_view& text);

/// Converts ASCII letters to small letters.
std::string small_letters(std::string_view text);

/// The words of some rows, with `between` between two.
template <class Rows, class Word = std::identity>
std::string listed(const Rows& rows, Word word = {}, std::string_view between = ", ") {
  std::string out;
  for (const auto& row : rows) {
    if (!out.empty()) out += between;
    out += std::invoke(word, row);
  }
  return out;
}

using Names = std::set<std::string, std::less<>>;

/// The names of some rows.
template <class Rows, class Name = std::identity>
Names names_of(const Rows& rows, Name name = {}) {
  Names out;
  for (const auto& row : rows) out.emplace(std::invoke(name, row));
  return out;
}

/// Candidate with the smallest edit distance to `word`, ignoring case; nothing if none is near enough for a typing
/// error.
std::optional<std::string> nearest(std::string_view word, const Names& candidates);

/// Remedy for an unknown name: the nearest one that is known, or other advice.
std::string did_you_mean(std::string_view word, const Names& known, const std::string& otherwise);

/// User text in quotes, truncated if long, with control characters escaped.
std::string in_quotes(std::string_view text);

/// As `in_quotes` without quotes, for a key in a place.
std::string printable(std::string_view text);

/// Path of a key in an object at `place`, which is empty for the document.
std::string joined(const std::string& place, std::string_view key);

/// Conversion of foreign texts (titles, notes, file names) for their target; every such text must pass through one of
/// these functions. All return valid UTF-8: invalid bytes become U+FFFD; control characters, which could drive a
/// terminal or reverse the direction of writing, become spaces.

/// For display, as part of a line.
std::string one_line(std::string_view text);

/// For display, with line breaks and tabs.
std::string lines_of(std::string_view text);

/// One-line comment, "# ...\n", for LAMMPS and LIGGGHTS decks and Python modules. Replaces what their parsers evaluate
/// in comments (quotation marks, variables, continued lines). Not for the first two lines of a Python module, where a
/// comment may set the encoding.
std::string deck_comment(std::string_view text);

/// Content or attribute of XML; line breaks become character references.
std::string xml_text(std::string_view text);

/// Indented JSON with a final line break; control characters are escaped.
std::string json_text(const nlohmann::ordered_json& value);

/// One-line JSON for an HTML element, including scripts: "<", ">", "&" and non-ASCII characters are escaped, so no text
/// can end the element or begin another.
std::string json_in_html(const nlohmann::ordered_json& value);

/// One shell word in single quotes.
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

/// Shell word for pasting: quoted only if necessary.
inline std::string shell_word_if_needed(std::string_view text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+,:@-";
  const bool as_it_is = !text.empty() && text[0] != '-' && text.find_first_not_of(plain) == std::string_view::npos;
  return as_it_is ? std::string(text) : shell_word(text);
}

/// Base64 with padding (RFC 4648).
std::string base64(std::string_view bytes);

/// FNV-1a, 64 bits, as 16 hexadecimal digits. Distinguishes contents; not cryptographic. Source: Fowler, Noll & Vo;
/// offset basis 0xcbf29ce484222325, prime 0x100000001b3.
inline std::string content_hash(std::string_view content) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : content) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3u;
  }
  return format("%016llx", static_cast<unsigned long long>(hash));
}

}  // namespace pastefit
