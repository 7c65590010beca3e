// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/collide.hpp>

#include "bench/characters/crowd.hpp"

namespace bch::cli {

/// Holds the answers for all pairs at one level of detail.
struct LevelAnswers {
  std::uint32_t depth = 0;
  double discs = 0;  ///< of a shape, mean
  std::vector<std::uint8_t> hits;
  std::uint64_t hit_count = 0;
  std::uint64_t cleared = 0;        ///< pairs that the single cylinder hits and this level does not
  double nanoseconds_per_pair = 0;  ///< median of the runs
  std::uint32_t runs = 0;
};

struct CrowdAnswers {
  std::vector<Pair> pairs;           ///< every pair that can collide at any level, sorted
  std::vector<LevelAnswers> levels;  ///< as in the shape set

  const LevelAnswers& finest() const { return levels.back(); }
};

/// Answers all candidates at every level, one batch call a level, and takes the time of it.
/// Precondition: level 0 of the set is depth 0.
CrowdAnswers answer_crowd(const ShapeSet& set, const Crowd& crowd, const QueryOptions& options);

}  // namespace bch::cli
