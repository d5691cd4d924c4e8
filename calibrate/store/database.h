#pragma once

#include <charconv>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

struct sqlite3;

namespace pastefit {

using Row = std::vector<std::string>;

/// The whole number that a column is, as text. Errors: throws `std::runtime_error` for any other text, and for a number
/// beyond its type.
template <class Number>
Number whole_number_of(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw std::runtime_error("what should be a whole number is none");
  return number;
}

/// `read`: the file is not changed where it cannot be, as in a folder that is read-only.
enum class DatabaseUse { read, write };

/// A connection to an SQLite file that closes itself. Errors of SQLite travel as `std::runtime_error`.
/// A symbolic link is not followed: what it points to, or would make, is somewhere else.
class Database {
 public:
  explicit Database(const std::filesystem::path& file, DatabaseUse use = DatabaseUse::write);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  /// Runs one statement with text parameters; answers all rows as text.
  std::vector<Row> run(const std::string& sql, const Row& parameters = {});

  /// The number that a statement answers. Errors: it answers none.
  int number(const std::string& sql);

 private:
  void check(int status);
  sqlite3* handle_ = nullptr;
};

/// All or nothing: rolls back unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();
  void commit();

 private:
  Database& database_;
  bool committed_ = false;
};

}  // namespace pastefit
