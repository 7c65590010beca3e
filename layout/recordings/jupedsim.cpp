// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/jupedsim.hpp"

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>

#include "layout/base/mixed_hash.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/recordings/numbers.hpp"
#include "layout/recordings/sqlite_database.hpp"

namespace bch::detail::trajectory {
namespace {

constexpr std::int64_t newest_version = 3;

enum Column : int { frame, id, pos_x, pos_y, ori_x, ori_y };
constexpr const char* jupedsim_columns[] = {"frame", "id", "pos_x", "pos_y", "ori_x", "ori_y"};

class JuPedSim final : public RowSource {
 public:
  JuPedSim(const std::filesystem::path& file, const TrajectoryOptions& options)
      : places_{file, false}, database_(places_, options.go_on), metres_(options.unit.value_or(1)) {
    require_tables();
    read_metadata(options);
    read_geometry();
    const std::string table = "trajectory_data";
    for (const int column : {frame, id, pos_x, pos_y})
      if (!database_.has_column(table, jupedsim_columns[column]))
        places_.reject("table trajectory_data has no column " + std::string(jupedsim_columns[column]));
    has_orientation_ = database_.has_column(table, "ori_x") && database_.has_column(table, "ori_y");
    // In the order of the file, whatever indices there are.
    const std::string from = " FROM trajectory_data NOT INDEXED";
    keys_.emplace(database_, "SELECT frame, id" + from);
    rows_.emplace(database_, "SELECT frame, id, pos_x, pos_y" +
                                 std::string(has_orientation_ ? ", ori_x, ori_y" : "") + from);
  }

  const Places& places() const override { return places_; }
  Recording recording() const override { return recording_; }

  std::size_t read(std::span<Row> rows) override {
    std::size_t count = 0;
    for (; count < rows.size() && step(*rows_); ++count) rows[count] = row();
    return count;
  }

  std::size_t read_keys(std::span<Row> rows) override {
    std::size_t count = 0;
    for (; count < rows.size() && step(*keys_); ++count) rows[count] = keys(*keys_);
    return count;
  }

  void rewind() override {
    keys_->reset();
    rows_->reset();
    number_ = 0;
    at_end_ = false;
  }

 private:
  Places places_;
  SqliteDatabase database_;
  double metres_;
  Recording recording_;
  std::optional<SqliteStatement> keys_, rows_;
  bool has_orientation_ = false, at_end_ = false;
  std::int64_t version_ = 0;
  std::uint64_t number_ = 0;

  void require_tables() {
    for (const char* const table : {"metadata", "trajectory_data"})
      if (!database_.has_table(table))
        places_.reject(std::string("is no JuPedSim file: has no table ") + table);
  }

  std::optional<std::string> metadata(const std::string& key) const {
    SqliteStatement value(database_, "SELECT value FROM metadata WHERE key = '" + key + "'");
    if (!value.step()) return std::nullopt;
    return std::string(value.text(0));
  }

  void read_metadata(const TrajectoryOptions& options) {
    const std::string text = metadata("version").value_or("");
    version_ = whole_number_from(text).value_or(0);
    if (version_ < 1 || version_ > newest_version)
      places_.reject("is of version " + shown(text) + " of JuPedSim's files; 1 to 3 are read");
    recording_.format = "JuPedSim SQLite, version " + std::to_string(version_);
    const std::optional<std::string> rate = metadata("fps");
    if (!rate || options.fps) return;
    const std::optional<double> fps = number_from(*rate);
    if (!fps) places_.reject("the frame rate " + shown(*rate) + " in its metadata is not a number");
    recording_.rate = checked_fps(places_, *fps, "the frame rate in its metadata");
  }

  /// Takes the geometry of the first frame.
  void read_geometry() {
    if (!database_.has_table("geometry")) return report_none();
    const bool by_frame = version_ > 1 && database_.has_table("frame_data");
    std::string which = " ORDER BY rowid LIMIT 1";
    if (by_frame) which = " AND hash = (SELECT geometry_hash FROM frame_data ORDER BY frame LIMIT 1)";
    SqliteStatement geometry(database_, "SELECT wkt FROM geometry WHERE length(wkt) > 0" + which);
    if (!geometry.step()) return take_the_only_geometry();
    recording_.geometry = geometry.text(0);
    const std::size_t count =
        by_frame ? different("geometry_hash", "frame_data") : different("wkt", "geometry");
    if (count > 1)
      recording_.assumptions.push_back("The geometry of the first frame is that of all: the file has " +
                                       std::to_string(count) + ", which differ.");
  }

  /// For a file whose first frame names none that is there.
  void take_the_only_geometry() {
    const std::size_t count = different("wkt", "geometry");
    if (count == 0) return report_none();
    if (count > 1) {
      recording_.assumptions.push_back("There are no walls: the file has " + std::to_string(count) +
                                       " geometries, and its first frame names none of them.");
      return;
    }
    SqliteStatement geometry(database_, "SELECT wkt FROM geometry WHERE length(wkt) > 0 LIMIT 1");
    if (geometry.step()) recording_.geometry = geometry.text(0);
    recording_.assumptions.emplace_back(
        "The only geometry of the file is that of all frames, though the first frame does not name it.");
  }

  void report_none() { recording_.assumptions.emplace_back("There are no walls: the file has no geometry."); }

  /// Returns how many different values a column has, other than none and an empty text. SQLite would keep them all, which may be long and share their pages.
  std::size_t different(const std::string& column, const std::string& table) const {
    SqliteStatement values(database_,
                           "SELECT " + column + " FROM " + table + " WHERE length(" + column + ") > 0");
    std::unordered_set<std::size_t, MixedHash> hashes;
    while (values.step()) hashes.insert(std::hash<std::string_view>()(values.text(0)));
    return hashes.size();
  }

  bool step(SqliteStatement& statement) {
    if (at_end_) return false;
    at_end_ = !statement.step();
    number_ += !at_end_;
    return !at_end_;
  }

  [[noreturn]] void reject(const SqliteStatement& row, Column column, const std::string& reason) const {
    places_.reject(number_,
                   std::string(jupedsim_columns[column]) + " " + shown(row.text(column)) + " " + reason);
  }
  [[noreturn]] void reject(Column column, const std::string& reason) const { reject(*rows_, column, reason); }

  std::int64_t integer(const SqliteStatement& row, Column column) const {
    if (row.type(column) != SQLITE_INTEGER) reject(row, column, "is not an integer");
    return row.integer(column);
  }

  double real(Column column) const {
    const int type = rows_->type(column);
    if (type != SQLITE_FLOAT && type != SQLITE_INTEGER) reject(column, "is not a number");
    return rows_->real(column);
  }

  double coordinate(Column column) const {
    const double metres = real(column) * metres_;
    if (!is_coordinate(metres)) reject(column, coordinate_fault(metres));
    return metres;
  }

  /// (0, 0) and NULL say nothing.
  float heading() const {
    if (rows_->type(ori_x) == SQLITE_NULL || rows_->type(ori_y) == SQLITE_NULL) return unknown;
    const double x = real(ori_x), y = real(ori_y);
    if (!is_finite(x)) reject(ori_x, "is not finite");
    if (!is_finite(y)) reject(ori_y, "is not finite");
    return x == 0 && y == 0 ? unknown : static_cast<float>(std::atan2(y, x));
  }

  Row keys(const SqliteStatement& from) const {
    Row row;
    row.number = number_;
    row.key = integer(from, frame);
    if (row.key > largest_frame || row.key < -largest_frame) reject(from, frame, "is not within +-1e15");
    row.id = integer(from, id);
    return row;
  }

  Row row() const {
    Row row = keys(*rows_);
    row.x = coordinate(pos_x);
    row.y = coordinate(pos_y);
    if (has_orientation_) row.heading = heading();
    return row;
  }
};

}  // namespace

std::unique_ptr<RowSource> open_jupedsim(const std::filesystem::path& file,
                                         const TrajectoryOptions& options) {
  return std::make_unique<JuPedSim>(file, options);
}

}  // namespace bch::detail::trajectory
