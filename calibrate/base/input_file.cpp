#include "calibrate/base/input_file.h"

#include <iconv.h>

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "calibrate/base/text.h"

namespace pastefit {
namespace {

namespace fs = std::filesystem;

/// Advice for a folder: the first few of its files with this ending.
std::string file_in(const fs::path& folder, std::string_view ending) {
  constexpr std::size_t most = 3;
  std::set<std::string> names;
  std::error_code error;
  if (!ending.empty())
    for (const auto& entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == ending) names.insert((folder / entry.path().filename()).string());
  while (names.size() > most) names.erase(std::prev(names.end()));
  return names.empty() ? "give a file" : "give a file of it: " + listed(names);
}

/// Converts bytes to UTF-8; nothing if the encoding does not match.
std::optional<std::string> converted(std::string_view bytes, const char* from) {
  const iconv_t converter = iconv_open("UTF-8", from);
  if (std::bit_cast<std::intptr_t>(converter) == -1) return std::nullopt;
  std::string in(bytes), out(4 * bytes.size() + 4, '\0');
  char *read = in.data(), *write = out.data();
  std::size_t left = in.size(), room = out.size();
  const bool all = iconv(converter, &read, &left, &write, &room) != static_cast<std::size_t>(-1) && left == 0;
  iconv_close(converter);
  out.resize(out.size() - room);
  return all ? std::optional(out) : std::nullopt;
}

}  // namespace

Result<std::string> read_input(const fs::path& file, const InputKind& kind) {
  const std::string name = printable(file.string());
  std::error_code error;
  if (file.native().find('\0') != std::string::npos) return Fault{name, "holds a null byte", "the path of a file"};
  const auto status = fs::status(file, error);
  if (!fs::exists(status)) {
    const bool circle = error == std::errc::too_many_symbolic_link_levels;
    return Fault{name, circle ? "is a symbolic link that goes in a circle" : "there is no such file", "check the path"};
  }
  if (fs::is_directory(status)) return Fault{name, "is a folder", file_in(file, kind.ending)};
  if (!fs::is_regular_file(status)) return Fault{name, "is not a regular file", std::string(kind.remedy)};
  const Fault too_large{name, "is larger than " + std::to_string(kind.largest_bytes >> 20) + " MB",
                        std::string(kind.remedy)};
  if (fs::file_size(file, error) > kind.largest_bytes && !error) return too_large;
  std::ifstream stream(file, std::ios::binary);
  std::string content;
  std::array<char, 65536> block;
  while (content.size() <= kind.largest_bytes && (stream.read(block.data(), block.size()) || stream.gcount() > 0))
    content.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  if (content.size() > kind.largest_bytes) return too_large;
  if (stream.bad() || !stream.eof()) return Fault{name, "cannot be read", "give a readable file"};
  return content;
}

std::optional<std::string> text_in_utf8(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) return converted(bytes, "UTF-16");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const auto utf8 = converted(bytes, "UTF-8");
  return utf8 ? utf8 : converted(bytes, "CP1252");
}

std::string trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? ""
                                         : std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

std::vector<CsvLine> csv_lines(std::string_view text, char separator) {
  std::vector<CsvLine> lines;
  std::size_t number = 1;
  bool quoted = false;
  std::string cell;
  lines.push_back({number, {}});
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    number += letter == '\n';
    if (quoted && letter == '"' && text.substr(i + 1).starts_with('"')) {
      cell += text[++i];
    } else if (letter == '"' && (quoted || cell.find_first_not_of(" \t") == std::string::npos)) {
      quoted = !quoted;
    } else if (!quoted && (letter == separator || letter == '\n')) {
      lines.back().cells.push_back(trimmed(cell));
      cell.clear();
      if (letter == '\n') lines.push_back({number, {}});
    } else {
      cell += letter;
    }
  }
  lines.back().cells.push_back(trimmed(cell));
  return lines;
}

}  // namespace pastefit
