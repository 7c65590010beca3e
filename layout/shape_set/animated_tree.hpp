// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <bch/shape_set.hpp>

namespace bch::detail {

/// Windows of keys, over each of which a node is a disc again that moves straight on, from where it is in the beginning to where it is in
/// the end, and is larger by what the keys between depart from that. Windows go on for a key at level 0, for four at level 1.
struct KeyWindows {
  std::vector<float> steps;   ///< per window: the farthest that a centre comes, metres
  std::vector<float> spares;  ///< nodes of each window: what their radii are larger by; none at level 0
};
constexpr unsigned window_levels = 2;
/// Returns how many keys a window goes on.
constexpr std::size_t window_length(unsigned level) noexcept {
  return std::size_t{1} << (2 * level);
}

/// The tree over the moving discs of a chunk: a binary tree, level by level, whose nodes are moving discs with the same keys. A node
/// holds its discs at every key, and so at all times between: the distance of two centres that move straight on is convex, and so
/// is that and the radius of the disc within, while the radius of the disc around is linear.
struct AnimatedTreeChunk {
  std::vector<double> times;
  std::vector<Disc> keys;                   ///< nodes at each key, key by key
  std::vector<std::uint32_t> first_child;   ///< per node; 0: a leaf. The second child is the next node
  std::vector<std::uint32_t> leaf_of_disc;  ///< per disc in the order in which they were given: its node
  std::vector<std::uint32_t> ring_ends;
  std::array<KeyWindows, window_levels> windows;

  std::size_t nodes() const noexcept { return first_child.size(); }
  const Disc* key(std::size_t k) const noexcept { return keys.data() + k * nodes(); }
  /// Returns the first key of the window that goes on from a key, and the last one.
  std::size_t window_begin(std::size_t key, unsigned level) const noexcept {
    return key & ~(window_length(level) - 1);
  }
  std::size_t window_end(std::size_t key, unsigned level) const noexcept {
    return std::min(window_begin(key, level) + window_length(level), times.size() - 1);
  }
};

/// An animated shape as queries read it.
struct AnimatedTree {
  std::vector<AnimatedTreeChunk> chunks;
  bool loops = false;
  double reach = 0;  ///< metres
  double speed = 0;  ///< the most that a centre moves in a second, and a radius grows, metres

  double begin() const noexcept { return chunks.front().times.front(); }
  double end() const noexcept { return chunks.back().times.back(); }
};

/// A time of a clip by its place among the keys: discs are (1 - share) of those at a key and share of those at the next one.
struct KeyPlace {
  std::size_t chunk, key;
  double share;  ///< from 0 to 1
};

/// Returns the place of a time of a clip from its beginning to its end, clamped to these.
KeyPlace key_place(const AnimatedTree& tree, double seconds) noexcept;

/// Returns the time of a clip that loops, or not, at which it looks as it does at any `seconds`.
double time_in_clip(const AnimatedTree& tree, double seconds) noexcept;

/// Builds the tree over a chunk that is valid.
AnimatedTreeChunk animated_tree_chunk(const AnimatedChunk& chunk);

}  // namespace bch::detail
