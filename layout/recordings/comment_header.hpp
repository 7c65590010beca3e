// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "layout/recordings/columns.hpp"

// Private to the readers of recordings: the comments before the rows of a text.

namespace bch::detail::trajectory {

/// Holds what comments say: "# framerate: 25 fps", "# id frame x/m y/m z/m", "#X,Y,Z: the agents coordinates (in metres)".
struct CommentHeader {
  bool any = false;
  std::optional<double> fps;
  std::optional<double> metres;  ///< a unit
  std::vector<ColumnName> names;
  std::uint64_t names_line = 0;

  /// Reads a comment, its '#' included.
  /// Errors:  throws TrajectoryError on a frame rate that is none.
  void read(const Places& places, std::uint64_t line, std::string_view comment);
};

}  // namespace bch::detail::trajectory
