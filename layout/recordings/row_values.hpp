// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "layout/base/number_class.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/recordings/motion_table.hpp"
#include "layout/recordings/numbers.hpp"
#include "layout/recordings/table_layout.hpp"

// Private to the readers of recordings: values of a table become rows.

namespace bch::detail::trajectory {

inline std::string shown(double value) {
  return shortest(value);
}
inline std::string shown(std::int64_t value) {
  return std::to_string(value);
}

/// Puts the values of a table, which are texts, doubles or whole numbers, into rows: scaled as its columns say, and checked one by one.
/// A number gives the same row as its shortest text.
class RowValues {
 public:
  RowValues(const Places& places, const TableLayout& layout) : places_(places), layout_(layout) {}

  void begin(Row& row, std::uint64_t number) {
    row = Row();
    row.number = number;
    character_ = clip_ = {};
    body_ = {};
    radius_ = 0;
  }

  /// Takes a row's value of a column, of which columns without a role take any.
  /// Errors:  throws TrajectoryError, naming the row and the column.
  template <class Value>
  void take(Row& row, std::size_t column, Value value) {
    row_ = row.number;
    switch (layout_.columns.roles[column]) {
      case Role::none:
        break;
      case Role::id:
        row.id = integer(column, value);
        break;
      case Role::frame:
        row.key = integer(column, value);
        if (row.key > largest_frame || row.key < -largest_frame)
          reject(column, value, "is not within +-1e15");
        break;
      case Role::time:
        row.key = microseconds_of(column, value);
        break;
      case Role::x:
        row.x = coordinate(column, value);
        break;
      case Role::y:
        row.y = coordinate(column, value);
        break;
      case Role::height:
        if (const double height = finite_or_nan(column, value); !is_nan(height))
          row.stature = heights_.take(height * layout_.height_metres);
        break;
      case Role::heading:
        row.heading = heading(column, value);
        break;
      case Role::character:
        character_ = text(column, value);
        break;
      case Role::clip:
        clip_ = text(column, value);
        break;
      case Role::clip_time:
        row.clip_seconds = clip_seconds(column, value);
        break;
      case Role::body:
        body_.kind = text(column, value);
        break;
      case Role::length:
        body_.length = millimetres(column, value, 1);
        break;
      case Role::width:
        body_.width = millimetres(column, value, 1);
        break;
      case Role::radius:
        radius_ = millimetres(column, value, 2);
        break;
    }
  }

  void end(Row& row) {
    settle_body();
    row.motion = motions_.find(character_, clip_, body_, places_, row.number);
  }

  /// Adds what the rows have given so far.
  void describe(Recording& recording) const {
    heights_.describe(recording.assumptions);
    recording.motions = motions_.all();
    if (any_unnamed_)
      recording.assumptions.emplace_back(
          "Rows with a length or a width, but without a body, are about boxes.");
    constexpr float turn = 6.3F;
    if (largest_heading_ > turn)
      recording.notes.push_back("Headings reach " + shortest(largest_heading_) +
                                " radians: are they degrees, as of a column 'heading [deg]'?");
    if (origin_ != 0) recording.origin = origin_ * layout_.seconds;
  }

 private:
  static constexpr double largest_clip_time = 1e6;  // seconds
  static constexpr double largest_size = 20;        // metres

  const Places& places_;
  const TableLayout& layout_;
  Heights heights_;
  MotionTable motions_;
  std::string_view character_, clip_;  ///< of the row that is read
  RowBody body_;                       ///< likewise
  int radius_ = 0;                     ///< likewise, twice, millimetres
  bool any_unnamed_ = false;           ///< bodies with a size, and not by a radius alone
  float largest_heading_ = 0;          ///< radians, of either sign
  std::uint64_t row_ = 0;              ///< its number
  std::optional<double> first_time_;   ///< of the table, in its unit
  double origin_ = 0;                  ///< likewise, the time whose key is 0

  template <class Value>
  [[noreturn]] void reject(std::size_t column, Value value, const std::string& reason) const {
    places_.reject(row_, layout_.columns.names[column] + " " + shown(value) + " " + reason);
  }

  template <class Value>
  std::string_view text(std::size_t column, Value value) const {
    if constexpr (std::is_same_v<Value, std::string_view>) return value;
    reject(column, value, "is not a name");
  }

  template <class Value>
  std::int64_t integer(std::size_t column, Value value) const {
    const std::optional<std::int64_t> number = whole_number_from(value);
    if (!number) reject(column, value, "is not a whole number");
    return *number;
  }

  template <class Value>
  double number(std::size_t column, Value value) const {
    if constexpr (!std::is_same_v<Value, std::string_view>) {
      return static_cast<double>(value);
    } else {
      const std::optional<double> number = number_from(value);
      if (!number) reject(column, value, "is not a number");
      return *number;
    }
  }

  template <class Value>
  double coordinate(std::size_t column, Value value) const {
    const double metres = number(column, value) * layout_.metres;
    if (!is_coordinate(metres)) reject(column, value, coordinate_fault(metres));
    return metres;
  }

  /// Times far from 0, such as those since 1970, count from the first of the table: the double nearest to one differs from it by an
  /// eighth of a microsecond at most, and the difference of two such is exact.
  template <class Value>
  std::int64_t microseconds_of(std::size_t column, Value value) {
    const double time = number(column, value), seconds = time * layout_.seconds;
    if (!is_finite(seconds)) reject(column, value, "is not finite");
    if (std::abs(seconds) > largest_origin)
      reject(column, value, "is not within +-1e11 s; the column's name may lack a unit, as in time/ms");
    if (!first_time_) {
      first_time_ = time;
      if (std::abs(seconds) > largest_time) origin_ = time;
    }
    const double since_first = (time - *first_time_) * layout_.seconds;
    if (std::abs(since_first) > largest_time && (origin_ != 0 || std::abs(seconds) > largest_time))
      reject(column, value, "is not within +-1e9 s of the first time, " + shortest(*first_time_));
    return std::llround((time - origin_) * layout_.seconds * microseconds);
  }

  /// A number that a row may lack.
  template <class Value>
  double finite_or_nan(std::size_t column, Value field) const {
    if constexpr (std::is_same_v<Value, std::string_view>)
      if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
    const double value = number(column, field);
    if (is_infinite(value)) reject(column, field, "is not finite");
    return value;
  }

  template <class Value>
  float clip_seconds(std::size_t column, Value value) const {
    const double seconds = finite_or_nan(column, value) * layout_.clip_seconds;
    if (std::abs(seconds) > largest_clip_time) reject(column, value, "is not within +-1e6 s");
    return static_cast<float>(seconds);
  }

  /// A size of a body, times a factor; 0 where the row lacks it.
  template <class Value>
  int millimetres(std::size_t column, Value value, int factor) const {
    const double metres = finite_or_nan(column, value) * layout_.size_metres * factor;
    if (is_nan(metres)) return 0;
    if (!(metres >= 0 && metres <= largest_size))
      reject(column, value, factor == 1 ? "is not from 0 to 20 m" : "is not from 0 to 10 m");
    return static_cast<int>(std::lround(1000 * metres));
  }

  /// Rows without a size and a kind are about people, and so are those that say so.
  void settle_body() {
    if (body_.kind == "person" || body_.kind == "pedestrian") {
      body_ = {};
      return;
    }
    const bool has_sides = body_.length > 0 || body_.width > 0;
    if (body_.kind.empty() && (has_sides || radius_ > 0)) {
      body_.kind = has_sides ? "box" : "disc";
      any_unnamed_ |= has_sides;
    }
    if (body_.length == 0) body_.length = radius_;
    if (body_.width == 0) body_.width = radius_;
  }

  template <class Value>
  float heading(std::size_t column, Value value) {
    const double radians = finite_or_nan(column, value) * layout_.radians;
    if (std::abs(radians) > rounding::largest_heading) reject(column, value, "is not within +-1e9");
    const auto taken = static_cast<float>(radians);
    largest_heading_ = std::max(largest_heading_, std::abs(taken));  // of which NaN is none
    return taken;
  }
};

}  // namespace bch::detail::trajectory
