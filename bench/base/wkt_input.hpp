// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <string>
#include <utility>

#include <bch/obstacles.hpp>

namespace bch::cli {

/// Reads obstacles from a file of well-known text; `heights`: metres, from bottom to top, of all of them.
/// Errors:  throws InputError with the file's name; for malformed text also line and column.
ObstacleSet read_obstacles(const std::string& file, Polygons polygons,
                           std::pair<double, double> heights = {-HUGE_VAL, HUGE_VAL});

}  // namespace bch::cli
