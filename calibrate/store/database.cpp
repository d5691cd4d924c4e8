#include "calibrate/store/database.h"

#include <sqlite3.h>
#include <unistd.h>

#include <cctype>
#include <memory>
#include <stdexcept>

#include "calibrate/base/text.h"

namespace pastefit {

namespace {

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

bool can_be_written(const std::filesystem::path& file) {
  return ::access(file.c_str(), W_OK) == 0 && ::access(folder_of(file).c_str(), W_OK) == 0;
}

/// URI of a file, with special bytes as %XX. `immutable` keeps SQLite from creating files beside it.
std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const unsigned char byte : std::filesystem::absolute(file).string())
    uri += std::isalnum(byte) || byte == '/' ? std::string(1, static_cast<char>(byte)) : format("%%%02X", byte);
  return uri + "?immutable=1";
}

}  // namespace

Database::Database(const std::filesystem::path& file, DatabaseUse use) {
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(file)))
    throw std::runtime_error("it is a symbolic link");
  const bool immutable = use == DatabaseUse::read && !can_be_written(file);
  const int flags = immutable ? SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX
                              : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
  const std::string name = immutable ? immutable_uri(file) : file.string();
  const int status = sqlite3_open_v2(name.c_str(), &handle_, flags, nullptr);
  if (status != SQLITE_OK) {
    const std::string message = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
    sqlite3_close(handle_);
    throw std::runtime_error(message);
  }
  sqlite3_busy_timeout(handle_, 2000);
  // The file may come from others: its schema may run no function, and only rows are written.
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
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
      const bool is_null = sqlite3_column_type(raw, column) == SQLITE_NULL;  // queried before the text is made
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(raw, column));
      if (!text && !is_null) throw std::runtime_error("out of memory");
      row.emplace_back(text ? text : "");
    }
    rows.push_back(std::move(row));
  }
  if (status != SQLITE_DONE) check(status);
  return rows;
}

int Database::number(const std::string& sql) {
  const std::vector<Row> rows = run(sql);
  if (rows.empty() || rows[0].empty()) throw std::runtime_error("nothing stands where a number belongs");
  return whole_number_of<int>(rows[0][0]);
}

void Database::transact(const std::function<void()>& statements) {
  run("BEGIN IMMEDIATE");
  try {
    statements();
    run("COMMIT");
  } catch (...) {
    sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);  // fails if SQLite has rolled back (full disk)
    throw;
  }
}

void Database::check(int status) {
  if (status != SQLITE_OK) throw std::runtime_error(sqlite3_errmsg(handle_));
}

}  // namespace pastefit
