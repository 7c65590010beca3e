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

#include "layout/recordings/row.hpp"

// Private to the readers of recordings: what the columns of a table are.

namespace bch::detail::trajectory {

enum class Role : std::uint8_t {
  none,
  id,
  frame,
  time,
  x,
  y,
  height,
  heading,
  character,
  clip,
  clip_time,
  body,
  length,
  width,
  radius
};

/// Holds the name of a column, in small letters, and its unit, as in "x/cm", "x [cm]", "x(cm)" or "x_cm".
struct ColumnName {
  std::string name, unit;
};

/// Takes a name apart.
ColumnName column_name(std::string_view word);

/// Takes names apart that a separator divides. '#' stands for any of commas, semicolons and blanks, as in comments.
std::vector<ColumnName> column_names(std::string_view line, char separator);

/// Returns what a name in small letters stands for, such as "pos_x" or "posx".
Role role_of(std::string_view name);

/// Returns whether there are names for all that a row needs.
bool has_all_roles(std::span<const ColumnName> names);

/// Holds the columns of a table, and their units.
struct Columns {
  std::vector<Role> roles;                           ///< of each column
  std::vector<std::string> names;                    ///< likewise, for messages
  std::optional<double> metres;                      ///< a unit of x and y
  std::optional<double> height_metres, size_metres;  ///< of the height; of length, width and radius
  std::optional<double> seconds;                     ///< a unit of time
  std::optional<double> clip_seconds;                ///< a unit of the time in a clip
  bool has_frames_and_time = false;                  ///< so that the time is the clip's
  std::optional<double> radians;                     ///< a unit of the heading
  bool has_angle = false;  ///< the heading is called angle, which is in degrees where no unit is said
  std::size_t needed = 0;  ///< columns up to the last that matters

  bool has(Role role) const;
  /// Returns a sentence that names the columns that are not read, but for those called "skip"; nothing where there are none.
  std::string ignored() const;
};

/// Finds out what named columns are. Where there are frames, a time is that of the row's clip, if there is one, or does not matter.
/// Errors:  throws TrajectoryError, naming the line if there is one, on columns that lack, are there twice, or are of an unknown unit, unless the
///          unit is given.
Columns columns_of(const Places& places, std::optional<std::uint64_t> line, std::span<const ColumnName> names,
                   bool unit_is_given);

/// Returns how many metres a unit has that is called so.
std::optional<double> metres_of(std::string_view unit);

}  // namespace bch::detail::trajectory
