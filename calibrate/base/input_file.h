#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace pastefit {

/// A kind of file that a user gives.
struct InputKind {
  std::size_t largest_bytes = 16u << 20;
  std::string_view remedy;    ///< what to give in place of a file that is none of this kind
  std::string_view ending{};  ///< of such files, ".json": the first few are named in place of their folder
};

/// The bytes of a file. Errors, each with its remedy: there is none, it cannot be read, it is a folder, it has no end
/// (a FIFO, a device), or it is larger than files of its kind are.
Result<std::string> read_input(const std::filesystem::path& file, const InputKind& kind);

/// A text as spreadsheets save it, in UTF-8: it is in UTF-8, in UTF-16 with its byte order mark, or else in Windows'
/// code page 1252. Nothing if it is in none of them.
std::optional<std::string> text_in_utf8(std::string_view bytes);

/// The text without blanks and line breaks at its ends.
std::string trimmed(std::string_view text);

struct CsvLine {
  std::size_t number = 0;  ///< from 1; of a line with breaks in its cells the first
  std::vector<std::string> cells;
};

/// The cells of a text between such separators, trimmed. A cell in quotes may hold separators, line breaks and doubled
/// quotes.
/// Source: RFC 4180.
std::vector<CsvLine> csv_lines(std::string_view text, char separator);

}  // namespace pastefit
