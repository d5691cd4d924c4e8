#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// Kind of user file.
struct InputKind {
  std::size_t largest_bytes = 16u << 20;
  std::string_view remedy;    ///< advice if the file is not of this kind
  std::string_view ending{};  ///< e.g. ".json"; the advice for a folder names its first few such files
};

/// Reads a file. Errors, each with its remedy: it is missing, unreadable, a folder, endless (a FIFO, a device), or
/// larger than its kind permits.
Result<std::string> read_input(const std::filesystem::path& file, const InputKind& kind);

/// Converts a text from a spreadsheet to UTF-8: from UTF-8, UTF-16 with byte order mark, otherwise Windows code page
/// 1252. Nothing if it is in none of them.
std::optional<std::string> text_in_utf8(std::string_view bytes);

/// Removes blanks and line breaks at both ends.
std::string trimmed(std::string_view text);

struct CsvLine {
  std::size_t number = 0;  ///< from 1; the first one of a line with breaks in its cells
  std::vector<std::string> cells;
};

/// Splits a text into trimmed cells. Quoted cells may contain separators, line breaks and doubled quotes. Source: RFC
/// 4180.
std::vector<CsvLine> csv_lines(std::string_view text, char separator);

}  // namespace pastefit
