#include "calibrate/base/wrapped_text.h"

#include <algorithm>

namespace pastefit {

namespace {

/// Letters, not bytes: in UTF-8 those that go on with a letter begin with 10.
std::size_t letters_in(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

/// Where the rest of a long line begins.
std::size_t hanging_indent(std::string_view line, std::size_t columns) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = std::min(line.find("  ", begin), line.size());
  const std::size_t second = std::min(line.find_first_not_of(' ', gap), line.size());
  const std::size_t column = letters_in(line.substr(0, second));
  return second < line.size() && column <= columns / 2 ? column : begin + 2;
}

/// Whether what stands around a blank is one number: "34.9 +- 6", "95 %".
bool within_number(std::string_view line, std::size_t blank) {
  const std::string_view before = line.substr(0, blank), after = line.substr(blank + 1);
  return after.starts_with('%') || after.starts_with("+- ") || before.ends_with("+-");
}

std::string wrapped_line(std::string_view line, std::size_t columns) {
  if (letters_in(line) <= columns) return std::string(line);
  const std::string indent(hanging_indent(line, columns), ' ');
  std::string out, row;
  bool has_word = false;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t word = std::min(line.find_first_not_of(' ', at), line.size());
    std::size_t end = line.find(' ', word);
    while (end < line.size() && within_number(line, end)) end = line.find(' ', end + 1);
    end = std::min(end, line.size());
    if (has_word && letters_in(row) + letters_in(line.substr(at, end - at)) > columns) {
      out += row + "\n";
      row = indent;
      at = word;
    }
    row += line.substr(at, end - at);
    has_word = true;
    at = end;
  }
  return out + row;
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t columns) {
  std::string out;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    out += wrapped_line(text.substr(0, end), columns);
    if (end == text.size()) return out;
    out += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace pastefit
