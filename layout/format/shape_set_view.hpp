// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include <bch/geometry.hpp>

namespace bch::detail {

/// The number of discs per block.
constexpr std::uint32_t block_width = 8;
/// The longest path, in blocks, from a root block to a leaf. Kernels size their stacks by it.
constexpr std::uint32_t max_wide_levels = 10;

/// The number of directions of supports, and the number of floats in a row of supports, which stores each of them
/// twice; see supports.hpp.
constexpr std::uint32_t support_directions = 32;
constexpr std::uint32_t support_stride = 2 * support_directions;

/// Holds eight discs in parallel arrays. Unused ones are padding: infinitely far away, so that they overlap nothing.
/// (A negative radius would not do: the test squares the sum of radii, so a large negative radius would be a hit.)
struct DiscBlock {
  float x[block_width], y[block_width], radius[block_width];
};

/// A node of the flat tree is named by a 32-bit number: the position of its first disc in ShapeSetView::nodes. A name
/// with the bit leaf_bit names a leaf block: any eight consecutive discs of the cut. A name without that bit names a
/// block, which has six arrays of eight. The first three are x, y and radius of nodes of the hierarchy. The fourth
/// has the names of the nodes below them, stored as the bits of floats. The fifth has outer radii: a disc about the
/// same centre with the outer radius encloses all discs of the cut below, which may protrude from the node's own
/// disc. The sixth has the nodes' numbers: that of an InnerNode, or leaf_bit + the position of a disc of the cut.
constexpr std::uint32_t leaf_bit = 0x80000000;
constexpr std::uint32_t block_names = 3 * block_width;  ///< from a block's first x, like the next two
constexpr std::uint32_t block_outer = 4 * block_width;
constexpr std::uint32_t block_nodes = 5 * block_width;
constexpr std::uint32_t block_floats = 6 * block_width;

/// Represents an inner node: a node above the cut of a level. Inner nodes follow the cut's discs, in the in-order
/// sequence of the binary tree. So inner node k stands between discs k and k + 1 of the cut: disc k is the last one
/// below its first child, and disc k + 1 the first one below its second child. The last disc has no such node;
/// padding takes its place. A cut of one disc has no node above it. Its disc is then stored as the only inner node,
/// too, and is its own parent.
struct InnerNode {
  float x, y, radius;
  /// The number, in the whole set, of the parent (for the root: of itself), and perhaps parent_of_cut_disc.
  std::uint32_t link;
};
/// A bit of links: the first child of the node is a disc of the cut.
constexpr std::uint32_t parent_of_cut_disc = 0x80000000;
constexpr std::uint32_t inner_floats = sizeof(InnerNode) / sizeof(float);
static_assert(sizeof(InnerNode) == 16);

/// Holds the root of a level of a shape.
struct Root {
  float x, y, radius;
  std::uint32_t row;  ///< the row of its supports, single_disc or no_supports
};
constexpr std::uint32_t single_disc = 0;  ///< the cut is the root disc alone
constexpr std::uint32_t no_supports = 1;  ///< several discs, but supports are of the deepest cut alone
constexpr std::uint32_t first_row = 2;
static_assert(sizeof(Root) == 16);

/// The level has no exact leaves: its depth is not all_depths, its cut is a single disc, or the shape has no outline.
constexpr std::uint32_t no_segments = 0xffffffff;

/// Holds the positions of a level's nodes: blocks, then the cut's discs (all x, all y, all radii), then its inner
/// nodes.
struct Tree {
  std::uint32_t top;     ///< the name of the topmost node
  std::uint32_t discs;   ///< position of the cut's first x
  std::uint32_t stride;  ///< distance from a cut disc's x to its y, and from its y to its radius
  std::uint32_t count;   ///< number of cut discs; padding follows up to the stride
  float outer_radius;    ///< metres: the root's outer radius
  std::uint32_t segments = no_segments;  ///< position of the leaves' words in leaf_segments, or no_segments
  std::uint32_t points = 0;              ///< with segments: position of the shape's points
  /// 1: every inner node encloses the cut discs below it with a margin; 0: some may not. If both trees have 1, nodes
  /// overlap wherever the discs below them do, also after rounding. The margin does not cover the rounding if one
  /// shape is much larger than the other (section VIII of layout/base/rounding.hpp).
  std::uint32_t conservative_nodes = 0;

  /// Returns the number of the first inner node: its position in `nodes` divided by inner_floats. (Always inlined, so
  /// that instruction sets share no function.)
  [[gnu::always_inline]] std::uint32_t first_inner() const noexcept {
    return (discs + 3 * stride + inner_floats - 1) / inner_floats;
  }
};

// The segments of an outline that the leaves of a tree contain are stored as one word per leaf, followed by lists.
// Segments are numbered by the points of the shape where they begin; each contour has its first point again at its
// end. A word names consecutive segments: the first in 24 bits, and their number, 1 to 127, in the next 7 bits. If
// segments are not consecutive or their numbers are too large, the top bit is set, and the rest is the position of a
// list, counted from the first word: the number of segments, then their numbers. The word 0 stands for more than 127
// segments: there the disc decides, because testing two such leaves would take too long.
constexpr std::uint32_t leaf_list = 0x80000000;
constexpr unsigned leaf_count_shift = 24;
constexpr std::uint32_t leaf_first_mask = (std::uint32_t{1} << leaf_count_shift) - 1;
constexpr std::uint32_t max_leaf_segments = 127;

/// The number of sectors of a profile, and the content of one sector; see profile.hpp. Values are metres from the
/// profile's centre, rounded so that no decision is wrong.
constexpr std::uint32_t profile_sectors = 32;
struct Sector {
  float inner;  ///< up to here the sector is inside the largest contour
  /// Upper bound of the support function in the sector's directions. It bounds the outline, or, if the shape has no
  /// segments, the discs of the deepest cut.
  float outer;
  float extent;  ///< lower bound of the contour's support function in the directions opposite to the sector's
  float shallow_outer;  ///< like outer, for all cuts of more than one disc except the deepest
};

/// Represents the extents of a shape along lines from a centre: a header, followed by sectors of the same size.
struct Profile {
  float x, y;  ///< the centre
  /// How far discs of the deepest cut protrude from the outline, metres. It is 0 in shapes whose stored supports and
  /// `outer` bound the discs; in all others these bound the outline.
  float excess;
  float discs_decide;  ///< 1 where a leaf of the deepest cut has no segments, else 0
  Sector sectors[profile_sectors];
};
static_assert(sizeof(Profile) == (1 + profile_sectors) * sizeof(Sector) && sizeof(Sector) == 16);

/// Represents a closed polygon of an outline.
struct Contour {
  Disc disc;  ///< the smallest enclosing one
  /// The range of its points. The first point is repeated at `end`, as the end of the last segment.
  std::uint32_t begin, end;
};
static_assert(sizeof(Contour) == 20);

/// Holds the contours of a shape.
struct ContourRange {
  std::uint32_t begin, end;
};

/// Holds the arrays of all shapes and levels as plain pointers, for kernels. Valid while the set lives.
/// Roots:   root r = shape * level_count + level.
struct ShapeSetView {
  std::uint32_t shape_count;
  std::uint32_t level_count;
  bool rows_follow_roots;  ///< root r has row first_row + r: there is one level, and no cut is a single disc

  const std::uint32_t* depths;  ///< one per level
  const Root* roots;
  const Tree* trees;        ///< per root; null, like `nodes`, if every level is a single disc
  const float* nodes;       ///< of all levels; see Tree
  const float* max_extent;  ///< per shape, metres, rounded up; null if `trees` is

  // Null if the plan has no culling data.
  const float* support;        ///< rows of support_stride floats; those before first_row are infinite
  const DiscBlock* inscribed;  ///< per shape; see interior.hpp
  const Profile* profiles;     ///< per shape

  // Null if the plan has no outlines, or if `trees` is null.
  const ContourRange* shape_contours;  ///< per shape
  const Contour* contours;
  const Vec2* points;
  const std::uint32_t* leaf_segments;  ///< words and lists, see Tree::segments; null if no tree has segments
  /// Per shape, metres: what it adds to the distance within which segments of two shapes meet (rounding.hpp, V).
  const float* segment_margin;

  const Heights* heights;  ///< per shape; null if the plan has no heights
};

}  // namespace bch::detail
