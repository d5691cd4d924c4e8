#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pastefit {

/// Source text embedded in the program (calibrate/embedded_texts.cmake), by its path in calibrate:
/// "laboratory/templates/lab.json". Nothing if there is none.
std::optional<std::string_view> embedded_text(std::string_view file);

/// The embedded text with @name@, of small letters and _, replaced by values. The line break after a value is dropped
/// if the value ends with one, or is empty and alone on its line. Throws std::logic_error for an unknown file,
/// std::out_of_range for an unknown name.
inline std::string filled_in(std::string_view file, const std::map<std::string_view, std::string>& values) {
  const auto found = embedded_text(file);
  if (!found) throw std::logic_error("no text is embedded as " + std::string(file));
  std::string_view rest = *found;
  std::string out;
  for (std::size_t begin = rest.find('@'); begin != rest.npos; begin = rest.find('@')) {
    const std::size_t end = std::min(rest.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", begin + 1), rest.size());
    if (!rest.substr(end).starts_with('@')) {
      out.append(rest.substr(0, end));
      rest.remove_prefix(end);
      continue;
    }
    out.append(rest.substr(0, begin)).append(values.at(rest.substr(begin + 1, end - begin - 1)));
    rest.remove_prefix(end + 1);
    if (rest.starts_with('\n') && (out.empty() || out.back() == '\n')) rest.remove_prefix(1);
  }
  return out.append(rest);
}

// Inserting values into the text of a starting file. Throws std::logic_error if a line to be replaced is missing, since
// a value would be lost.

/// Begin of the line after the one at `at`.
inline std::size_t line_after(const std::string& text, std::size_t at) {
  const std::size_t end = text.find('\n', at);
  if (end == std::string::npos) throw std::logic_error("a starting file lacks lines that are to be replaced");
  return end + 1;
}

/// Begin of the first line that has `beginning` after its blanks.
inline std::size_t line_with(const std::string& text, std::string_view beginning) {
  std::size_t at = 0;
  while (!std::string_view(text).substr(std::min(text.find_first_not_of(' ', at), text.size())).starts_with(beginning))
    at = line_after(text, at);
  return at;
}

inline std::string blanks_at(const std::string& text, std::size_t at) {
  return std::string(text.find_first_not_of(' ', at) - at, ' ');
}

inline void exchange_lines(std::string& text, std::size_t first, std::size_t last, const std::string& before,
                           const std::vector<std::string>& instead) {
  std::string lines;
  for (const std::string& line : instead) lines += before + line + "\n";
  text.replace(first, last - first, lines);
}

/// Replaces `count` lines from the first one that begins with `beginning` after its indentation, which is kept. An
/// empty `instead` removes them.
inline void replace_lines(std::string& text, std::string_view beginning, const std::vector<std::string>& instead,
                          std::size_t count = 1) {
  const std::size_t first = line_with(text, beginning);
  std::size_t last = first;
  for (std::size_t k = 0; k < count; ++k) last = line_after(text, last);
  exchange_lines(text, first, last, blanks_at(text, first), instead);
}

/// Replaces the lines between the first one that begins with `beginning` and its closing brace, with two more blanks.
inline void replace_inside(std::string& text, std::string_view beginning, const std::vector<std::string>& instead) {
  const std::size_t line = line_with(text, beginning), first = line_after(text, line);
  const std::string outside = blanks_at(text, line);
  std::size_t last = first;
  while (!std::string_view(text).substr(last).starts_with(outside + "}")) last = line_after(text, last);
  exchange_lines(text, first, last, outside + "  ", instead);
}

/// Source in starting files, for the user to replace.
inline constexpr std::string_view kSourceToFillIn = "laboratory, person, date";

/// The source of a file; empty if nobody has replaced that of the starting file.
inline std::string stated_source(const std::string& source) {
  return source == kSourceToFillIn ? std::string() : source;
}

}  // namespace pastefit
