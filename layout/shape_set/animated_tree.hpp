// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <bch/shapes.hpp>

#include "layout/base/rounding.hpp"
#include "layout/shape_set/animated_hulls.hpp"

namespace bch::detail {

constexpr std::uint32_t animated_width = 8;  ///< the most children of a node

/// The time that a loop takes at least, seconds. Sums of times of up to 1e6 s are off by less than a millionth of it, so that rounds follow
/// each other also then.
constexpr double shortest_loop = 0.001;

/// Added to the radii of leaves at a time, and to those of nodes, times the reach: nodes have room to spare about the leaves below, also for
/// what rounding both moves. That is at most 8 u of nodes that are rounded once, and, of those that are made of two others, three roundings
/// each of up to 12 nodes between a leaf and the root.
constexpr double margin_of_leaves = rounding::query_margin,
                 margin_of_nodes = margin_of_leaves + rounding::held_margin + 48 * rounding::unit_roundoff;

/// Holds the nodes of a chunk at a key, in the chunk's steps. Eight may be read from each on, beyond the last one, too.
struct NodesAtKey {
  const std::int16_t *x, *y;
  const std::uint16_t* radius;
  const std::int16_t* z;  ///< of spheres
};

/// Holds nodes that follow each other, from one to before another.
struct NodeRange {
  std::uint32_t begin, end;
};

/// Represents a time of a clip by its place among the keys: discs are (1 - fraction) of those at a key and fraction of those at the next one.
struct KeyPlace {
  std::size_t chunk, key;
  double fraction;  ///< from 0 to 1

  float blend(float from, float to) const noexcept {
    return static_cast<float>(double{from} + (double{to} - double{from}) * fraction);
  }
};

/// Holds the tree over the moving discs of a chunk, whose nodes are moving discs with the same keys; spheres alike. A node holds its discs at every key,
/// and so at all times between: the distance of two centres that move straight on is convex, and so is that and the radius
/// of the disc within, while the radius of the disc around is linear.
///
/// Nodes stand level by level, so that the children of one, up to eight, follow each other, and those of the next one follow them. All
/// leaves are on the last level, behind all other nodes. Their numbers are of 16 bits, times a step.
struct AnimatedTreeChunk {
  std::vector<double> times;
  double step = 0;  ///< a power of two, metres
  std::vector<std::uint16_t>
      numbers;  ///< at each key all x, all y, all radii and of spheres all z, then `animated_width` more
  bool in_space = false;  ///< whether discs are spheres
  std::vector<std::uint16_t>
      child_begin;  ///< per node above the leaves: its first child; and the number of nodes
  std::vector<std::uint16_t> leaf_of_disc;  ///< per disc in the order in which they were given: its node
  float speed = 0;  ///< the most that a node's centre moves in a second, as seen from above, metres

  std::uint32_t nodes() const noexcept { return child_begin.back(); }
  std::uint32_t first_leaf() const noexcept { return static_cast<std::uint32_t>(child_begin.size() - 1); }
  bool is_leaf(std::uint32_t node) const noexcept { return node >= first_leaf(); }
  /// Returns the children of a node that is no leaf.
  NodeRange children(std::uint32_t node) const noexcept { return {child_begin[node], child_begin[node + 1]}; }

  NodesAtKey key(std::size_t k) const noexcept {
    const std::uint16_t* const x = numbers.data() + k * (in_space ? 4 : 3) * nodes();
    const auto as_signed = [](const std::uint16_t* at) { return reinterpret_cast<const std::int16_t*>(at); };
    return {as_signed(x), as_signed(x + nodes()), x + 2 * nodes(),
            in_space ? as_signed(x + 3 * nodes()) : nullptr};
  }
  /// Returns a node at a key, exactly.
  Disc disc(std::size_t k, std::uint32_t node) const noexcept {
    const NodesAtKey at = key(k);
    const auto metres = [this](int number) { return static_cast<float>(number * step); };
    return {metres(at.x[node]), metres(at.y[node]), metres(at.radius[node])};
  }
  /// Returns the height of a node's centre at a key, exactly; 0 of discs.
  float z(std::size_t k, std::uint32_t node) const noexcept {
    return in_space ? static_cast<float>(key(k).z[node] * step) : 0;
  }
  /// Returns a node at a time.
  Disc disc(const KeyPlace& at, std::uint32_t node) const noexcept {
    const Disc from = disc(at.key, node), to = disc(at.key + 1, node);
    return {at.blend(from.x, to.x), at.blend(from.y, to.y), at.blend(from.radius, to.radius)};
  }
  /// Returns the height of a node's centre at a time.
  float z(const KeyPlace& at, std::uint32_t node) const noexcept {
    return at.blend(z(at.key, node), z(at.key + 1, node));
  }
};

/// Represents an animated shape as queries read it.
struct AnimatedTree {
  std::vector<AnimatedTreeChunk> chunks;
  AnimatedHulls hulls;
  bool loops = false;
  bool in_space = false;  ///< whether discs are spheres
  double reach = 0;       ///< as seen from above, metres
  double height = 0;      ///< the most that a sphere reaches above or below its agent's ground, metres
  double speed = 0;       ///< the most that a centre moves in a second, and a radius grows, metres

  double begin() const noexcept { return chunks.front().times.front(); }
  double end() const noexcept { return chunks.back().times.back(); }
  double length() const noexcept { return end() - begin(); }
};

/// Returns the place of a time of a clip from its beginning to its end, clamped to these.
KeyPlace key_place(const AnimatedTree& tree, double seconds) noexcept;

/// Returns the time of a clip that loops, or not, at which it looks as it does at any `seconds`.
double time_in_clip(const AnimatedTree& tree, double seconds) noexcept;

/// Builds the tree over a chunk that is valid. Its discs are rounded to the step, outward; those whose numbers are of 16 bits as they are
/// keep them, where no radius is more than two fifths of the largest coordinate.
///
/// Derivation: a centre goes to the nearest multiple, at most sqrt(1/2) steps away, and the radius up to the next multiple of itself and
/// that way, so that the new disc holds the old one, and reaches out of it by less than 2 sqrt(1/2) + 1 < 2.42 steps. A step is 2^-14 of the
/// reach at most. Of spheres sqrt(3/4) stands for sqrt(1/2), a sixth for two fifths, and the reach in space for that on the ground.
AnimatedTreeChunk animated_tree_chunk(const AnimatedChunk& chunk);

}  // namespace bch::detail
