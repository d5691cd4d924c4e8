#include "calibrate/store/database.h"

#include <sqlite3.h>

#include <memory>
#include <stdexcept>

namespace pastefit {

Database::Database(const std::filesystem::path& file) {
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
  const int status = sqlite3_open_v2(file.c_str(), &handle_, flags, nullptr);
  if (status != SQLITE_OK) {
    const std::string message = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
    sqlite3_close(handle_);
    throw std::runtime_error(message);
  }
  sqlite3_busy_timeout(handle_, 2000);
}

Database::~Database() {
  sqlite3_close(handle_);
}

std::vector<Row> Database::run(const std::string& sql, const Row& parameters) {
  sqlite3_stmt* raw = nullptr;
  check(sqlite3_prepare_v2(handle_, sql.c_str(), -1, &raw, nullptr));
  const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement(raw, sqlite3_finalize);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    check(sqlite3_bind_text(raw, static_cast<int>(i) + 1, parameters[i].data(), static_cast<int>(parameters[i].size()),
                            SQLITE_STATIC));
  std::vector<Row> rows;
  int status;
  while ((status = sqlite3_step(raw)) == SQLITE_ROW) {
    Row row;
    for (int column = 0; column < sqlite3_column_count(raw); ++column) {
      const bool is_null = sqlite3_column_type(raw, column) == SQLITE_NULL;  // ask before the text is made
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(raw, column));
      if (!text && !is_null) throw std::runtime_error("out of memory");
      row.emplace_back(text ? text : "");
    }
    rows.push_back(std::move(row));
  }
  if (status != SQLITE_DONE) check(status);
  return rows;
}

void Database::check(int status) {
  if (status != SQLITE_OK) throw std::runtime_error(sqlite3_errmsg(handle_));
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (committed_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const std::exception&) {
    // SQLite has rolled back by itself (full disk); there is nothing left to undo.
  }
}

void Transaction::commit() {
  database_.run("COMMIT");
  committed_ = true;
}

}  // namespace pastefit
