// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/base/options.hpp"
#include "bench/placing/placing.hpp"

namespace bch::cli {

/// Holds what `bch place` is asked for.
struct PlaceOptions {
  std::vector<std::string> characters{"default:male", "default:female"};
  std::vector<std::string> clip_names{"walk"};
  bench::PlacingOptions placing;
  std::optional<double> speed;  ///< none: that of the clip
  double fps = 30;
  std::string csv, json;
  std::string obstacles;  ///< a file of well-known text; empty: none
  std::string paths;      ///< a recording; empty: arcs
};

/// Holds everything that a run of `bch place` knows in the end.
struct PlaceRun {
  const PlaceOptions& options;
  bench::PlacingOptions area;            ///< what is filled
  std::vector<std::string> assumptions;  ///< of what the file of paths does not say
  std::vector<bench::PlacedClip> clips;
  double build_seconds;  ///< of the moving bodies
  bench::Placement placement;
  double search_seconds;
};

std::string text_report(const PlaceRun& run);
nlohmann::ordered_json json_report(const PlaceRun& run);
/// Writes the people as a recording: id, time, x, y, stature, heading, character, clip,
/// clip_time.
std::string csv_report(const PlaceRun& run);

/// The paths of the people of a recording, each from time 0 on.
struct GivenPaths {
  std::vector<bench::GivenPath> paths;   ///< by ascending id
  std::vector<std::string> assumptions;  ///< of what the file does not say
  double width = 0, depth = 0;           ///< of the rectangle that holds all paths, metres; at least 1 m
};

/// Reads a recording as `bch check` does, with headings as there, and keeps so many seconds of each path. Who arrives sooner stands there.
/// Errors:  throws TrajectoryError, naming the file and the line.
GivenPaths read_paths(const std::string& file, double seconds);

}  // namespace bch::cli
