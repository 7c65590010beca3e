// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>
#include <vector>

#include "bench/placing/placing.hpp"

namespace bch::cli {

/// The ways of the people of a recording, each from time 0 on.
struct GivenPaths {
  std::vector<bench::GivenPath> paths;   ///< by ascending id
  std::vector<std::string> assumptions;  ///< of what the file does not say
  double width = 0, depth = 0;           ///< of the rectangle that holds all paths, metres; at least 1 m
};

/// Reads a recording as `bch check` does, with headings as there, and keeps so many seconds of each way. Who arrives sooner stands there.
/// Errors:  throws TrajectoryError, naming the file and the line.
GivenPaths read_paths(const std::string& file, double seconds);

}  // namespace bch::cli
