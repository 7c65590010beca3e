// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/table.hpp"

#include <cmath>
#include <utility>

#include "layout/base/number_class.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/recordings/fields.hpp"
#include "layout/recordings/motion_table.hpp"
#include "layout/recordings/numbers.hpp"
#include "layout/recordings/table_layout.hpp"

namespace bch::detail::trajectory {
namespace {

constexpr double largest_clip_time = 1e6;  // seconds

class Table final : public RowSource {
 public:
  Table(const std::filesystem::path& file, const TrajectoryOptions& options)
      : places_{file, true}, lines_(places_), layout_(table_layout(places_, lines_, options)) {
    rewind();
  }

  const Places& places() const override { return places_; }

  Recording recording() const override {
    Recording all = layout_.recording;
    heights_.describe(all.assumptions);
    all.motions = motions_.all();
    if (origin_ != 0) all.origin = origin_ * layout_.seconds;
    if (unended_ > 0)
      all.assumptions.push_back(
          "The last row, " + places_.row(unended_) +
          ", has no line end and is read as it stands; a file that was cut off looks so.");
    return all;
  }

  std::size_t read(std::span<Row> rows) override {
    std::size_t count = 0;
    for (std::string_view line; count < rows.size() && lines_.next(line);) {
      if (lines_.number() < layout_.first_line || line.empty() || is_comment(line)) continue;
      if (is_blank(line.front()) && trimmed(line).empty()) continue;
      rows[count] = Row();
      parse(line, rows[count]);
      if (!lines_.has_end()) unended_ = lines_.number();
      ++count;
    }
    return count;
  }

  void rewind() override { lines_.rewind(); }

 private:
  Places places_;
  LineReader lines_;
  TableLayout layout_;
  Heights heights_;
  MotionTable motions_;
  std::string_view character_, clip_;  ///< of the row that is read
  std::uint64_t unended_ = 0;          ///< the number of the last row where no line end follows it
  std::optional<double> first_time_;   ///< of the file, in its unit
  double origin_ = 0;                  ///< likewise, the time whose key is 0

  [[noreturn]] void reject(const std::string& reason) const { places_.reject(lines_.number(), reason); }
  [[noreturn]] void reject(std::size_t column, std::string_view value, const std::string& reason) const {
    reject(layout_.columns.names[column] + " " + shown(value) + " " + reason);
  }

  void parse(std::string_view line, Row& row) {
    row.number = lines_.number();
    character_ = clip_ = {};
    Fields fields(line, layout_.separator);
    const std::size_t columns = layout_.columns.roles.size();
    const std::size_t wanted = layout_.has_all_columns ? columns : layout_.columns.needed;
    std::size_t column = 0;
    for (std::string_view field; column < wanted && fields.next(field); ++column) take(column, field, row);
    std::string_view more;
    const bool has_more = layout_.has_all_columns && column == wanted && fields.next(more);
    if (fields.is_broken()) reject("a quote is not closed, or something follows it");
    if (column < wanted)
      reject("has " + std::to_string(column) + " values, not " + std::to_string(wanted) + ": " + shown(line));
    if (has_more) reject("has more values than the header has columns, the next is " + shown(more));
    row.motion = motions_.find(character_, clip_, places_, row.number);
  }

  void take(std::size_t column, std::string_view field, Row& row) {
    switch (layout_.columns.roles[column]) {
      case Role::none:
        break;
      case Role::id:
        row.id = whole_number(column, field);
        break;
      case Role::frame:
        row.key = whole_number(column, field);
        if (row.key > largest_frame || row.key < -largest_frame)
          reject(column, field, "is not within +-1e15");
        break;
      case Role::time:
        row.key = microseconds_of(column, field);
        break;
      case Role::x:
        row.x = coordinate(column, field);
        break;
      case Role::y:
        row.y = coordinate(column, field);
        break;
      case Role::height:
        if (const double height = finite_or_nan(column, field); !is_nan(height))
          row.stature = heights_.take(height * layout_.height_metres);
        break;
      case Role::heading:
        row.heading = heading(column, field);
        break;
      case Role::character:
        character_ = field;
        break;
      case Role::clip:
        clip_ = field;
        break;
      case Role::clip_time:
        row.clip_seconds = clip_seconds(column, field);
        break;
    }
  }

  std::int64_t whole_number(std::size_t column, std::string_view field) const {
    const std::optional<std::int64_t> number = whole_number_from(field);
    if (!number) reject(column, field, "is not a whole number");
    return *number;
  }

  double number(std::size_t column, std::string_view field) const {
    const std::optional<double> value = number_from(field);
    if (!value) reject(column, field, "is not a number");
    return *value;
  }

  double coordinate(std::size_t column, std::string_view field) const {
    const double metres = number(column, field) * layout_.metres;
    if (!is_coordinate(metres)) reject(column, field, coordinate_fault(metres));
    return metres;
  }

  /// Times far from 0, such as those since 1970, count from the first of the file: the double nearest to one differs from it by an
  /// eighth of a microsecond at most, and the difference of two such is exact.
  std::int64_t microseconds_of(std::size_t column, std::string_view field) {
    const double time = number(column, field), seconds = time * layout_.seconds;
    if (!is_finite(seconds)) reject(column, field, "is not finite");
    if (std::abs(seconds) > largest_origin)
      reject(column, field, "is not within +-1e11 s; the column's name may lack a unit, as in time/ms");
    if (!first_time_) {
      first_time_ = time;
      if (std::abs(seconds) > largest_time) origin_ = time;
    }
    const double since_first = (time - *first_time_) * layout_.seconds;
    if (std::abs(since_first) > largest_time && (origin_ != 0 || std::abs(seconds) > largest_time))
      reject(column, field, "is not within +-1e9 s of the first time, " + shortest(*first_time_));
    return std::llround((time - origin_) * layout_.seconds * microseconds);
  }

  /// A number that a row may lack.
  double finite_or_nan(std::size_t column, std::string_view field) const {
    const double value = field.empty() ? std::numeric_limits<double>::quiet_NaN() : number(column, field);
    if (is_infinite(value)) reject(column, field, "is not finite");
    return value;
  }

  float clip_seconds(std::size_t column, std::string_view field) const {
    const double seconds = finite_or_nan(column, field) * layout_.clip_seconds;
    if (std::abs(seconds) > largest_clip_time) reject(column, field, "is not within +-1e6 s");
    return static_cast<float>(seconds);
  }

  float heading(std::size_t column, std::string_view field) const {
    const double radians = finite_or_nan(column, field) * layout_.radians;
    if (std::abs(radians) > rounding::largest_heading) reject(column, field, "is not within +-1e9");
    return static_cast<float>(radians);
  }
};

}  // namespace

std::unique_ptr<RowSource> open_table(const std::filesystem::path& file, const TrajectoryOptions& options) {
  return std::make_unique<Table>(file, options);
}

}  // namespace bch::detail::trajectory
