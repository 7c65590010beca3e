// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/sqlite_database.hpp"

#include <algorithm>
#include <fstream>
#include <utility>

#include "layout/recordings/sqlite_log_index.hpp"

namespace bch::detail::trajectory {
namespace {

constexpr int locked_milliseconds = 500;
constexpr int longest_value = 1 << 24;  // bytes: of a geometry

// What reading may cost, in steps of SQLite's machine. A row takes 7 bytes at least, and 10 to 25 steps in all scans together. Pages
// count too: a value that goes on over many is a step.
constexpr int steps_a_call = 500;
constexpr std::uint64_t steps_a_byte = 4, steps_of_any_file = 1'000'000;
constexpr std::uint64_t bytes_of_a_page_a_step = 16;

std::uint64_t size_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  return error ? 0 : size;
}

bool is_there(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

/// What SQLite would find of a database, and beside it.
struct Found {
  std::filesystem::path file;  ///< the place of links' target, beside which the others lie
  std::uint64_t bytes = 0, page_size = 0;
  bool lacks_log = false;    ///< changes go to a log, where there is one
  bool lacks_index = false;  ///< of the log; no program has it open

  explicit Found(const std::filesystem::path& name) {
    std::error_code error;
    file = std::filesystem::canonical(name, error);
    if (error) file = std::filesystem::absolute(name);
    char first[20] = {};
    std::ifstream(file, std::ios::binary).read(first, sizeof first);
    const auto byte = [&](int at) {
      return static_cast<std::uint64_t>(static_cast<unsigned char>(first[at]));
    };
    page_size = std::max<std::uint64_t>(512, byte(17) == 1 ? 65'536 : byte(16) * 256);
    const std::filesystem::path log = sibling("-wal"), index = sibling("-shm");
    bytes = size_of(file) + size_of(log);
    if (byte(19) != 2) return;  // has no log
    const bool is_empty = size_of(log) == 0;
    lacks_log = is_empty && size_of(sibling("-journal")) == 0 && !(is_there(log) && is_there(index));
    lacks_index = !is_empty && !is_there(index);
  }

  std::filesystem::path sibling(const char* ending) const {
    std::filesystem::path other = file;
    return other += ending;
  }
};

/// Names a file to SQLite. An absolute path is never the name of something else, such as ":memory:".
std::string uri_of(const std::filesystem::path& file) {
  std::string uri = "file://";
  for (const char c : file.string())
    if (c == '%' || c == '?' || c == '#')
      uri += c == '%' ? "%25" : c == '?' ? "%3f" : "%23";
    else
      uri += c;
  return uri;
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

SqliteDatabase::SqliteDatabase(const Places& places, std::function<bool()> go_on)
    : places_(&places), go_on_(std::move(go_on)) {
  open();
  restrict_it();
  run("BEGIN");
}

/// Opens the file so that nothing is made beside it: SQLite makes a log where it finds none, and an index of the log.
void SqliteDatabase::open() {
  const Found found(places_->file);
  page_size_ = found.page_size;
  max_cost_ = steps_of_any_file + steps_a_byte * found.bytes;
  sqlite3* handle = nullptr;
  // Where it fails, the handle says why.
  sqlite3_open_v2((uri_of(found.file) + (found.lacks_log ? "?immutable=1" : "")).c_str(), &handle,
                  SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_URI, nullptr);
  handle_.reset(handle);
  if (!handle_) places_->reject("cannot be opened: out of memory");
  if (sqlite3_errcode(handle) != SQLITE_OK) fail();
  if (found.lacks_index) log_index_ = keep_log_index_in_memory(handle);
}

/// Called by SQLite now and then. Trees that are graphs would have it read the same pages for ever.
/// Returns: whether it has to end what it does.
int SqliteDatabase::on_progress(void* of) {
  auto& database = *static_cast<SqliteDatabase*>(of);
  database.cost_ += steps_a_call;
  for (const int counted : {SQLITE_DBSTATUS_CACHE_HIT, SQLITE_DBSTATUS_CACHE_MISS}) {
    int pages = 0, unused = 0;
    sqlite3_db_status(database.get(), counted, &pages, &unused, 1);
    database.cost_ += static_cast<std::uint64_t>(pages) * database.page_size_ / bytes_of_a_page_a_step;
  }
  database.is_cancelled_ = database.go_on_ && !database.go_on_();
  return static_cast<int>(database.is_cancelled_ || database.cost_ > database.max_cost_);
}

void SqliteDatabase::restrict_it() {
  sqlite3* const db = handle_.get();
  sqlite3_progress_handler(db, steps_a_call, on_progress, this);
  sqlite3_busy_timeout(db, locked_milliseconds);
  for (const int off :
       {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_ENABLE_VIEW,
        SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, SQLITE_DBCONFIG_DQS_DDL, SQLITE_DBCONFIG_DQS_DML})
    sqlite3_db_config(db, off, 0, nullptr);
  for (const int on : {SQLITE_DBCONFIG_DEFENSIVE, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE})
    sqlite3_db_config(db, on, 1, nullptr);
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

/// For a file whose writer was stopped. Taking its change back would change the file.
void SqliteDatabase::reject_half_a_change() const {
  const std::filesystem::path file = sqlite3_db_filename(handle_.get(), "main");
  places_->reject(
      "holds a change that was never finished: the program sqlite3 takes it back when it opens a copy of the "
      "file and of its journal, " +
      shown(file.filename().string() + "-journal"));
}

void SqliteDatabase::fail() const {
  const std::string reason = sqlite3_errmsg(handle_.get());
  switch (sqlite3_errcode(handle_.get())) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      places_->reject("is locked by another program: " + reason);
    case SQLITE_INTERRUPT:
      if (is_cancelled_) places_->reject("reading it was cancelled");
      places_->reject("is damaged: reading it takes more steps than files of its size can need");
    case SQLITE_READONLY:
      if (sqlite3_extended_errcode(handle_.get()) == SQLITE_READONLY_ROLLBACK) reject_half_a_change();
      places_->reject("cannot be read by SQLite: " + reason);
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

}  // namespace bch::detail::trajectory
