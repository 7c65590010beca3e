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

/// The least duration of a loop, seconds. Times up to 1e6 s accumulate less than a millionth of it as rounding error,
/// so rounds stay in order.
constexpr double shortest_loop = 0.001;

/// Margins of radii at a time, times the extent. The margin of nodes is larger, so that nodes enclose their
/// descendants with room to spare, also for the rounding of both: 8 u for nodes that are rounded once, and, for a
/// node made of two others, three roundings for each of up to 12 nodes between a leaf and the root.
constexpr double margin_of_leaves = rounding::query_margin,
                 margin_of_nodes =
                     margin_of_leaves + rounding::conservative_margin + 48 * rounding::unit_roundoff;

/// Holds the nodes of a chunk at a key, in steps of the chunk. From any node, animated_width elements can be read,
/// also beyond the last node.
struct NodesAtKey {
  const std::int16_t *x, *y;
  const std::uint16_t* radius;
  const std::int16_t* z;  ///< of spheres
};

/// Holds the range of indices of consecutive nodes, from begin to before end.
struct NodeRange {
  std::uint32_t begin, end;
};

/// Represents a time of a clip by its place among the keys: discs are interpolated linearly between `key` and key +
/// 1.
struct KeyPlace {
  std::size_t chunk, key;
  double fraction;  ///< from 0 to 1

  float blend(float from, float to) const noexcept {
    return static_cast<float>(double{from} + (double{to} - double{from}) * fraction);
  }
};

/// Holds the tree over the moving discs or spheres of a chunk. The nodes are moving discs with the same keys. A node
/// encloses its discs at every key, and so at all times between: the distance of two linearly moving centres is
/// convex in time, so that distance plus the radius of the enclosed disc is convex, while the radius of the enclosing
/// disc is linear.
///
/// Nodes are stored level by level, so up to eight children of a node are consecutive and precede the children of the
/// next node. All leaves are on the last level, after all other nodes. Coordinates and radii are 16-bit integers
/// times a step.
struct AnimatedTreeChunk {
  std::vector<double> times;
  double step = 0;  ///< a power of two, metres
  std::vector<std::uint16_t>
      numbers;            ///< per key: all x, all y, all radii and, for spheres, all z; then padding
  bool in_space = false;  ///< whether discs are spheres
  std::vector<std::uint16_t>
      child_begin;  ///< per node above the leaves: its first child; then the number of nodes
  std::vector<std::uint16_t> leaf_of_disc;  ///< per disc, in the given order: its node
  float speed = 0;  ///< the largest speed of a node's centre, seen from above, metres per second

  std::uint32_t nodes() const noexcept { return child_begin.back(); }
  std::uint32_t first_leaf() const noexcept { return static_cast<std::uint32_t>(child_begin.size() - 1); }
  bool is_leaf(std::uint32_t node) const noexcept { return node >= first_leaf(); }
  /// Returns the children of an inner node.
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
  /// Returns the height of a node's centre at a key, exactly; 0 for discs.
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
  double max_extent = 0;  ///< as seen from above, metres
  double height = 0;  ///< the largest distance of a sphere's points above or below its agent's ground, metres
  double speed = 0;   ///< a bound on how fast centres move and radii grow, metres per second

  double begin() const noexcept { return chunks.front().times.front(); }
  double end() const noexcept { return chunks.back().times.back(); }
  double length() const noexcept { return end() - begin(); }
};

/// Returns the place of a time among the keys. Times before the begin or after the end of the clip are clamped.
KeyPlace key_place(const AnimatedTree& tree, double seconds) noexcept;

/// Returns the time within the clip at which the body looks as at `seconds`, whether the clip loops or not.
double time_in_clip(const AnimatedTree& tree, double seconds) noexcept;

/// Builds the tree over a valid chunk. Discs are rounded outward to the step. Discs whose numbers are 16-bit
/// multiples of a power of two stay exact if no radius is more than two fifths of the largest coordinate.
///
/// Derivation: each coordinate of a centre goes to the nearest multiple of the step, so the centre moves by at most
/// sqrt(1/2) steps. The radius plus that distance is rounded up. So the new disc encloses the old one and protrudes
/// from it by less than 2 sqrt(1/2) + 1 < 2.42 steps. A step is at most 2^-14 of the extent. For spheres, sqrt(3/4)
/// takes the place of sqrt(1/2), a sixth that of two fifths, and the extent in space that of the extent on the ground.
AnimatedTreeChunk animated_tree_chunk(const AnimatedChunk& chunk);

}  // namespace bch::detail
