// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>

#include <bch/obstacles.hpp>

namespace bch::cli {

/// Reads obstacles from a file of well-known text.
/// Errors:  throws InputError with the file's name; for malformed text also line and column.
ObstacleSet read_obstacles(const std::string& file, Polygons polygons);

}  // namespace bch::cli
