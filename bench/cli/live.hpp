// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include <bch/bodies.hpp>

#include "bench/characters/walking_crowd.hpp"
#include "bench/cli/crowd.hpp"

namespace bch::cli {

/// Holds the milliseconds that frames took.
struct FrameTimes {
  std::vector<double> posing, queries;

  std::vector<double> whole() const;
};

/// Holds everything that a run of `bch crowd --live` knows in the end. Pairs are those of the last frame, sorted.
struct LiveRun {
  const CrowdOptions& options;
  std::span<const LoadedCharacter> characters;
  const WalkingCrowd& crowd;
  const LiveBodies& bodies;
  FrameTimes times;
  std::vector<Pair> candidates, collisions;
  std::size_t checked;  ///< candidates that were compared with brute force
  const char* implementation;
  unsigned threads;
};

/// Poses all agents anew and finds who collides, frame after frame; the first one is not timed. Writes and prints what is asked for.
/// Errors:  throws std::logic_error where answers differ from those of brute force.
void run_live_crowd(const CrowdOptions& options);

std::string text_report(const LiveRun& run);
nlohmann::ordered_json json_report(const LiveRun& run);

}  // namespace bch::cli
