// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <string>
#include <utility>

#include <bch/obstacles.hpp>

namespace bch::cli {

/// Reads a file of well-known text, which may be a pipe. A NUL byte ends it, which obstacles_of() then rejects.
/// Errors:  throws InputError with the file's name; also on a pipe or device of more than 256 MiB.
std::string read_wkt(const std::string& file);

/// Takes obstacles from the text of a file; `heights`: metres, from bottom to top, of all of them.
/// Errors:  throws InputError with the file's name, line and column.
ObstacleSet obstacles_of(const std::string& file, const std::string& text, Polygons polygons,
                         std::pair<double, double> heights = {-HUGE_VAL, HUGE_VAL});

/// Reads obstacles from a file of well-known text, as both above do.
ObstacleSet read_obstacles(const std::string& file, Polygons polygons,
                           std::pair<double, double> heights = {-HUGE_VAL, HUGE_VAL});

}  // namespace bch::cli
