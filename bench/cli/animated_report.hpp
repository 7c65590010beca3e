// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include <bch/shape_set.hpp>

namespace bch::cli {

/// Returns the slabs of a clip, from the ground up, or the whole body.
std::span<const AnimatedDiscs> slabs_or_whole(const AnimatedDiscs& discs);

/// Holds properties of a clip as moving discs.
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

/// Represents a clip as moving discs, seen at a time.
struct AnimatedView {
  std::string character, clip;
  const AnimatedDiscs& discs;
  double seconds;
  const Shape* body;  ///< of the pose at that time, cut as the discs are; null: unknown
};

/// Represents a slab of a clip at the time of a view, or a body that is whole.
struct AnimatedPart {
  const AnimatedDiscs& discs;
  const AnimatedShape& shape;
  const AnimatedChunk& chunk;  ///< that of the time
  const Outline* outline;      ///< of the pose; null: unknown
  std::string heights;         ///< "0.40 to 1.00 m", "slab 3" where nothing is; empty: the body is whole
};

/// Returns the slabs of a clip, the highest first, as bodies stand, or the whole body. `shape` is that of the view's discs.
std::vector<AnimatedPart> parts_of(const AnimatedView& view, const AnimatedShape& shape);
/// Returns "112 discs in 2 rings".
std::string text_of(const AnimatedChunk& chunk);

std::string text_of(const AnimatedView& view);
nlohmann::ordered_json json_of(const AnimatedView& view);

/// Draws, slab by slab, the discs at the time on the body's outline and, from key to key, the rings and the ways of the discs; what they
/// cover at times all over the clip; and the keys and discs of its chunks along the time.
std::string draw_animated(const AnimatedView& view);

}  // namespace bch::cli
