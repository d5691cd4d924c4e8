#pragma once

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pastefit {

/// Lines of a starting file, for inserting values. Throws std::logic_error if a line to be replaced is missing, since a
/// value would be lost.
class TemplateLines {
 public:
  explicit TemplateLines(const std::string& text) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines_.push_back(line);
  }

  /// Replaces `count` lines from the first one that begins with `beginning` after its indentation, which is kept. An
  /// empty `instead` removes them.
  void replace(std::string_view beginning, const std::vector<std::string>& instead, std::size_t count = 1) {
    const std::size_t at = find(beginning);
    if (count > lines_.size() - at) missing(std::to_string(count) + " lines from " + std::string(beginning));
    exchange(at, at + count, instead, blanks(lines_[at]));
  }

  /// Replaces the lines between the first one that begins with `beginning` and its closing brace, with two more blanks.
  void replace_inside(std::string_view beginning, const std::vector<std::string>& instead) {
    const std::size_t first = find(beginning) + 1;
    const std::string outside = blanks(lines_[first - 1]);
    std::size_t last = first;
    while (last < lines_.size() && !lines_[last].starts_with(outside + "}")) ++last;
    if (last == lines_.size()) missing("the end of " + std::string(beginning));
    exchange(first, last, instead, outside + "  ");
  }

  std::string text() const {
    std::string out;
    for (const std::string& line : lines_) out += line + "\n";
    return out;
  }

 private:
  static std::string blanks(const std::string& line) {
    return line.substr(0, std::min(line.find_first_not_of(' '), line.size()));
  }
  [[noreturn]] static void missing(const std::string& what) {
    throw std::logic_error("a starting file lacks what is to be replaced: " + what);
  }
  std::size_t find(std::string_view beginning) const {
    for (std::size_t at = 0; at < lines_.size(); ++at)
      if (std::string_view(lines_[at]).substr(blanks(lines_[at]).size()).starts_with(beginning)) return at;
    missing(std::string(beginning));
  }
  void exchange(std::size_t first, std::size_t last, const std::vector<std::string>& instead,
                const std::string& before) {
    std::vector<std::string> indented;
    for (const std::string& line : instead) indented.push_back(before + line);
    const auto at = lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(first),
                                 lines_.begin() + static_cast<std::ptrdiff_t>(last));
    lines_.insert(at, indented.begin(), indented.end());
  }

  std::vector<std::string> lines_;
};

/// Placeholder of the source in starting files.
inline constexpr std::string_view kSourceToFillIn = "laboratory, person, date";

/// The given source; empty if it is still the placeholder.
inline std::string stated_source(const std::string& source) {
  return source == kSourceToFillIn ? std::string() : source;
}

}  // namespace pastefit
