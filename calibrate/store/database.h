#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "calibrate/base/text.h"

struct sqlite3;

namespace pastefit {

using Row = std::vector<std::string>;

/// Parses a column as a whole number. Errors: throws `std::runtime_error` for other text, and for a number out of
/// range.
template <class Number>
Number whole_number_of(const std::string& text) {
  const auto number = parsed_number<Number>(text);
  if (!number) throw std::runtime_error("what should be a whole number is none");
  return *number;
}

/// `read`: works on files that cannot be written, e.g. in a read-only folder.
enum class DatabaseUse { read, write };

/// Connection to an SQLite file, closed by the destructor. Errors of SQLite are thrown as `std::runtime_error`.
/// Symbolic links are rejected, because they may lead outside the folder.
class Database {
 public:
  explicit Database(const std::filesystem::path& file, DatabaseUse use = DatabaseUse::write);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  /// Runs one statement with text parameters; returns all rows as text.
  std::vector<Row> run(const std::string& sql, const Row& parameters = {});

  /// Result of a statement as a number. Errors: throws if there is none.
  int number(const std::string& sql);

  /// Calls `statements` in a transaction, which is rolled back if they throw.
  void transact(const std::function<void()>& statements);

 private:
  void check(int status);
  sqlite3* handle_ = nullptr;
};

}  // namespace pastefit
