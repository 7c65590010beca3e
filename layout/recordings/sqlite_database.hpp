// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "layout/recordings/row.hpp"

// Private to the readers of recordings: SQLite files that are not trusted. The only user of SQLite.

namespace bch::detail::trajectory {

class SqliteDatabase;

/// Represents a query and its current row.
class SqliteStatement {
 public:
  SqliteStatement(const SqliteDatabase& database, const std::string& sql);

  /// Goes to the next row.
  /// Returns: whether there is one.
  /// Errors:  throws TrajectoryError.
  bool step();
  /// Goes back before the first row.
  void reset() { sqlite3_reset(handle_.get()); }

  sqlite3_stmt* get() const { return handle_.get(); }
  int type(int column) const { return sqlite3_column_type(handle_.get(), column); }
  std::int64_t integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }
  double real(int column) const { return sqlite3_column_double(handle_.get(), column); }
  /// Returns a value as text, as long as the row is there; empty for NULL.
  std::string_view text(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };
  const SqliteDatabase* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

/// Represents a database that is only read: within limits, without triggers, views, extensions or other files, in one transaction, so that
/// all queries see the same. No file is made or changed, except for the index of a log, where there is one.
/// Errors:  all functions throw TrajectoryError, also where a go_on() that is not empty says no.
class SqliteDatabase {
 public:
  SqliteDatabase(const Places& places, std::function<bool()> go_on);
  SqliteDatabase(const SqliteDatabase&) = delete;
  SqliteDatabase& operator=(const SqliteDatabase&) = delete;

  const Places& places() const { return *places_; }
  sqlite3* get() const { return handle_.get(); }

  /// Returns whether there is a table of that name.
  /// Errors:  also on a view or a virtual table of that name, and on tables that compute columns.
  bool has_table(const std::string& name) const;
  /// Returns whether a table has a column.
  bool has_column(const std::string& table, std::string_view column) const;

  /// Throws what SQLite says is wrong.
  [[noreturn]] void fail() const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close(handle); }
  };
  const Places* places_;
  std::function<bool()> go_on_;
  bool is_cancelled_ = false;
  std::uint64_t page_size_ = 0, cost_ = 0, max_cost_ = 0;
  std::shared_ptr<void> log_index_;  ///< which the handle uses
  std::unique_ptr<sqlite3, Close> handle_;

  static int on_progress(void* database);
  void open();
  void restrict_it();
  void run(const char* sql) const;
  [[noreturn]] void reject_half_a_change() const;
};

}  // namespace bch::detail::trajectory
