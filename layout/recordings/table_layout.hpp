// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/recordings/columns.hpp"
#include "layout/recordings/line_reader.hpp"
#include "layout/recordings/trajectory.hpp"

// Private to the readers of recordings: where the rows of a text begin, and what their columns are.

namespace bch::detail::trajectory {

struct TableLayout {
  Recording recording;
  char separator = ' ';
  Columns columns;
  double metres = 1, height_metres = 1, size_metres = 1;  ///< a unit
  double seconds = 1, radians = 1;                        ///< likewise
  double clip_seconds = 1;                                ///< likewise
  std::uint64_t first_line = 1;                           ///< with a row
  bool has_all_columns = false;  ///< every row has as many fields as there are columns
};

inline bool is_comment(std::string_view line) {
  return line.starts_with('#');
}

/// Reads the beginning of a text: PeTrack's and Juelich's, with comments or without a header; CSV with a header, Pathfinder's
/// among it; ETH/UCY's columns. Four or five columns without names are an id and a frame, in either order as FirstRows tells, then x, y
/// and z; the recording's assumptions say so and show rows.
/// Errors:  throws TrajectoryError on what is none of these, where a unit is not known, and on other columns without names.
TableLayout table_layout(const Places& places, LineReader& lines, const TrajectoryOptions& options);

/// Says what columns in memory are, by their names.
/// Errors:  throws TrajectoryError as columns_of() does.
TableLayout layout_of_columns(const Places& places, std::span<const ColumnName> names,
                              const TrajectoryOptions& options);

}  // namespace bch::detail::trajectory
