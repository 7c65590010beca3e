// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include <bch/shape_set.hpp>

namespace bch::cli {

/// Properties of a clip as moving discs.
struct AnimatedFacts {
  double seconds = 0;
  bool loops = false;
  std::size_t slabs = 0;             ///< 0: the body is whole
  std::size_t chunks = 0, keys = 0;  ///< of all slabs
  std::size_t fewest = 0, most = 0;  ///< discs of a chunk
  double mean = 0;                   ///< discs of a chunk
  std::size_t bytes = 0;             ///< in a baked file
};

AnimatedFacts facts_of(const AnimatedDiscs& discs);

/// Returns "1.20 s, loops, 9 chunks, 112 to 150 discs, 48.1 kB".
std::string text_of(const AnimatedFacts& facts);
nlohmann::ordered_json json_of(const AnimatedFacts& facts);

/// A clip of a whole body as moving discs, looked at at a time.
struct AnimatedView {
  std::string character, clip;
  const AnimatedDiscs& discs;
  double seconds;
  const Outline* outline;  ///< of the pose at that time; null: unknown
};

/// Returns the part of the clip that holds a time.
const AnimatedChunk& chunk_at(const AnimatedDiscs& discs, double seconds);

std::string text_of(const AnimatedView& view);
nlohmann::ordered_json json_of(const AnimatedView& view);

/// Draws the discs at the time on the body's outline; from key to key, the rings and the ways of the discs; what they cover at times
/// all over the clip; and the keys and discs of its chunks along the time.
std::string draw_animated(const AnimatedView& view);

}  // namespace bch::cli
