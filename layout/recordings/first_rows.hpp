// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "layout/recordings/columns.hpp"

// Private to the readers of recordings: what rows tell about columns that have no names.

namespace bch::detail::trajectory {

/// Selects what the first two columns are; the next two are x and y.
enum class ColumnOrder : std::uint8_t { unclear, id_first, frame_first };

/// Holds the first rows of a text.
class FirstRows {
 public:
  static constexpr std::size_t most = 4096;

  void add(std::uint64_t line, std::span<const std::string_view> fields);

  /// Returns the number of fields of the first row.
  std::size_t columns() const { return columns_; }
  /// Returns whether most rows begin with two whole numbers, as ids and frames are, and two coordinates.
  bool have_places() const { return places_.size() > others_; }

  /// Tells ids from frames by the distances between rows: from frame to frame a person moves less than a third of the distance to somebody else,
  /// and, alone, less than a twelfth of the extent of all rows.
  ColumnOrder order_by_distances() const;
  /// Returns whether these few rows have one number first and may be those of a person who is no faster than people
  /// run. `speed`: metres a second of a person who moves by one unit from frame to frame.
  bool may_be_one_person(double speed) const;
  /// Tells ids from frames by the steps between different numbers: frames of ETH/UCY have a common divisor above 1, as each tenth is
  /// there, and ids have none.
  ColumnOrder order_by_steps() const;
  /// Returns whether a fifth column is no height: below 0 somewhere, as headings are, or varying along a person's path where the third or
  /// the fourth never does, as ETH's y behind its heights.
  bool has_other_in_fifth(ColumnOrder order) const;

  /// Returns the first rows as they stand in the file, for messages.
  std::string shown() const;
  /// Returns the first rows as they are read, for messages: "line 1 has id 1, frame 43, x 7.9, y 77.4".
  std::string read_as(const Columns& columns) const;

 private:
  struct Place {
    std::int64_t first, second;
    double x, y, z;
  };
  struct Line {
    std::uint64_t number;
    std::vector<std::string> fields;
  };

  std::size_t columns_ = 0, others_ = 0;
  std::vector<Place> places_;  ///< of the rows except for others_
  std::vector<Line> lines_;    ///< those that messages show

  std::vector<Place> by_person(ColumnOrder order) const;
  double extent() const;
  std::optional<double> median_distance(ColumnOrder order) const;
};

}  // namespace bch::detail::trajectory
