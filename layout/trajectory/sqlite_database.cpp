// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/trajectory/sqlite_database.hpp"

namespace bch::detail::trajectory {
namespace {

constexpr int locked_milliseconds = 500;
constexpr int longest_value = 1 << 24;  // bytes: of a geometry

sqlite3* open_read_only(const std::filesystem::path& file) {
  sqlite3* handle = nullptr;
  // An absolute path is never the name of something else, such as ":memory:". Where it fails, the handle says why.
  sqlite3_open_v2(std::filesystem::absolute(file).c_str(), &handle,
                  SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX, nullptr);
  return handle;
}

}  // namespace

SqliteStatement::SqliteStatement(const SqliteDatabase& database, const std::string& sql)
    : database_(&database) {
  sqlite3_stmt* handle = nullptr;
  const int code =
      sqlite3_prepare_v2(database.get(), sql.c_str(), static_cast<int>(sql.size()), &handle, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) database.fail();
}

bool SqliteStatement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_->fail();
  return false;
}

std::string_view SqliteStatement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  if (bytes == nullptr) return {};
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}

SqliteDatabase::SqliteDatabase(const Places& places)
    : places_(&places), handle_(open_read_only(places.file)) {
  if (!handle_) places.reject("cannot be opened: out of memory");
  if (sqlite3_errcode(handle_.get()) != SQLITE_OK) fail();
  restrict_it();
  run("BEGIN");
}

void SqliteDatabase::restrict_it() const {
  sqlite3* const db = handle_.get();
  sqlite3_busy_timeout(db, locked_milliseconds);
  for (const int off :
       {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW,
        SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, SQLITE_DBCONFIG_DQS_DDL, SQLITE_DBCONFIG_DQS_DML})
    sqlite3_db_config(db, off, 0, nullptr);
  sqlite3_db_config(db, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_limit(db, SQLITE_LIMIT_LENGTH, longest_value);
  sqlite3_limit(db, SQLITE_LIMIT_SQL_LENGTH, 1 << 16);
  sqlite3_limit(db, SQLITE_LIMIT_COLUMN, 100);
  sqlite3_limit(db, SQLITE_LIMIT_EXPR_DEPTH, 20);
  sqlite3_limit(db, SQLITE_LIMIT_COMPOUND_SELECT, 2);
  sqlite3_limit(db, SQLITE_LIMIT_VDBE_OP, 10'000);
  sqlite3_limit(db, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_limit(db, SQLITE_LIMIT_TRIGGER_DEPTH, 1);
  sqlite3_limit(db, SQLITE_LIMIT_WORKER_THREADS, 0);
  run("PRAGMA query_only = ON");
  run("PRAGMA trusted_schema = OFF");
  run("PRAGMA cell_size_check = ON");
  run("PRAGMA mmap_size = 0");
  run("PRAGMA temp_store = MEMORY");
}

void SqliteDatabase::run(const char* sql) const {
  if (sqlite3_exec(handle_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void SqliteDatabase::fail() const {
  const std::string reason = sqlite3_errmsg(handle_.get());
  switch (sqlite3_errcode(handle_.get())) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      places_->reject("is locked by another program: " + reason);
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      places_->reject("is damaged: " + reason);
    default:
      places_->reject("cannot be read by SQLite: " + reason);
  }
}

bool SqliteDatabase::has_table(const std::string& name) const {
  SqliteStatement entry(*this,
                        "SELECT type, rootpage, sql FROM sqlite_schema WHERE lower(name) = '" + name + "'");
  if (!entry.step()) return false;
  if (entry.text(0) != "table" || entry.integer(1) == 0)  // which virtual tables have
    places_->reject(name + " is not a plain table: " + shown(entry.text(2)));
  SqliteStatement columns(*this, "SELECT name FROM pragma_table_xinfo('" + name + "') WHERE hidden <> 0");
  if (columns.step())
    places_->reject("column " + shown(columns.text(0)) + " of " + name + " is computed, not stored");
  return true;
}

bool SqliteDatabase::has_column(const std::string& table, std::string_view column) const {
  SqliteStatement columns(*this, "SELECT lower(name) FROM pragma_table_xinfo('" + table + "')");
  while (columns.step())
    if (columns.text(0) == column) return true;
  return false;
}

std::int64_t SqliteDatabase::bytes() const {
  SqliteStatement pages(*this, "PRAGMA page_count"), page(*this, "PRAGMA page_size");
  return pages.step() && page.step() ? pages.integer(0) * page.integer(0) : 0;
}

}  // namespace bch::detail::trajectory
