// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include <bch/geometry.hpp>

namespace bch::detail {

/// The number of discs of a block.
constexpr std::uint32_t block_width = 8;
/// The longest path, in blocks, from a root block to a leaf. Kernels size their stacks by it.
constexpr std::uint32_t max_wide_levels = 10;

/// Directions of supports, and the floats that a set's supports take; see supports.hpp.
constexpr std::uint32_t support_directions = 32;
constexpr std::uint32_t support_stride = 2 * support_directions;

/// Holds eight discs side by side; what is left over is padding that overlaps nothing: infinitely far away. (A negative
/// radius would hit, because the sum of radii is squared.)
struct DiscBlock {
  float x[block_width], y[block_width], radius[block_width];
};

/// A node is named by where its discs begin among ShapeSetView::nodes. With this bit it is a leaf window: eight discs of
/// the cut, one after the other, anywhere. Without, it is a block: x, y and radius of eight nodes of the hierarchy,
/// then the names of the eight nodes below, by their bits, the outer radii, which about the same centres hold the cut's discs
/// below (those stick out of the smallest disc), and which node of the hierarchy each is: the number of an inner node, or
/// leaf_window + where a disc of the cut stands.
constexpr std::uint32_t leaf_window = 0x80000000;
constexpr std::uint32_t block_names = 3 * block_width;  ///< from a block's first x; this and the next two
constexpr std::uint32_t block_outer = 4 * block_width;
constexpr std::uint32_t block_nodes = 5 * block_width;
constexpr std::uint32_t block_floats = 6 * block_width;

/// Represents a node above the cut of a level. These stand behind the cut's discs in the in-order sequence of the binary tree: number k
/// of a level is the node whose first child's last disc is disc k of the cut. Instead of such a node for the last disc there
/// is padding; a cut that is one disc has that disc there, as its root.
struct InnerNode {
  float x, y, radius;
  std::uint32_t
      link;  ///< number of the node above among all of the set, the root's its own; and the next bit
};
/// A link's bit: the node's first child is a disc of the cut.
constexpr std::uint32_t above_cut_disc = 0x80000000;
constexpr std::uint32_t inner_floats = sizeof(InnerNode) / sizeof(float);
static_assert(sizeof(InnerNode) == 16);

/// Holds the root of a level of a shape.
struct Root {
  float x, y, radius;
  std::uint32_t row;  ///< of its supports, or one of the next two
};
constexpr std::uint32_t single_disc = 0;  ///< the cut is the root disc alone
constexpr std::uint32_t no_supports = 1;  ///< it is more, at another level than the deepest
constexpr std::uint32_t first_row = 2;
static_assert(sizeof(Root) == 16);

/// The level has no exact leaves: it is not that of all depths or a single disc, or the shape has no outline.
constexpr std::uint32_t no_segments = 0xffffffff;

/// Holds the places of a level's nodes: blocks, then the cut's discs, all x, all y and all radii, then its inner
/// nodes.
struct Tree {
  std::uint32_t top;                     ///< node
  std::uint32_t discs;                   ///< where the first x is
  std::uint32_t stride;                  ///< from a cut disc's x to its y, and from there to its radius
  std::uint32_t count;                   ///< cut discs; where they are fewer than the stride, padding follows
  float outer_radius;                    ///< metres: the root's outer radius
  std::uint32_t segments = no_segments;  ///< where the words of the leaves are among leaf_segments, or that
  std::uint32_t points = 0;              ///< with segments: where the shape's points are
  /// 1: every node above a cut disc holds it with room to spare, so that nodes of two such trees overlap wherever their discs do, unless
  /// one shape is much larger; see layout/base/rounding.hpp, VIII.
  std::uint32_t nodes_hold_discs = 0;

  /// Returns the number of the first inner node: the number of floats from `nodes` on, by four. (Inlined for certain, so that
  /// instruction sets share no function.)
  [[gnu::always_inline]] std::uint32_t first_inner() const noexcept {
    return (discs + 3 * stride + inner_floats - 1) / inner_floats;
  }
};

// Which segments of an outline the leaves of a tree hold: a word a leaf, then lists. Segments are numbered by the points of the
// shape where they begin, contour after contour, each with its first point again at its end. A word names a run of segments: its
// first one in 24 bits, and how many there are, 1 to 127, in the next 7. Where these do not follow each other or numbers are
// too large, the top bit is set, and the rest says where a list begins, counted from the first word: how many segments, then
// their numbers. 0 stands for more than 127 segments: there the disc decides, else two such leaves would take too long.
constexpr std::uint32_t leaf_list = 0x80000000;
constexpr unsigned leaf_count_shift = 24;
constexpr std::uint32_t leaf_first_mask = (std::uint32_t{1} << leaf_count_shift) - 1;
constexpr std::uint32_t max_leaf_segments = 127;

/// Sectors of a profile, and what lies in one; see profile.hpp. Metres from the profile's centre, rounded so that it
/// decides nothing wrongly.
constexpr std::uint32_t profile_sectors = 32;
struct Sector {
  float inner;  ///< the largest contour's inside goes on to there
  float
      outer;  ///< upper bound of the support function of the outline in the sector's directions, or of the deepest cut without segments
  float extent;         ///< lower bound of the contour's support function in the opposite directions
  float shallow_outer;  ///< like outer, of all levels that are more than a disc and not the deepest
};

/// Represents a shape along lines from a centre: a record, and then as large a record for each sector.
struct Profile {
  float x, y;  ///< the centre
  /// How far discs of the deepest cut stick out of the outline, which supports and `outer` bound; 0 where these bound discs. Metres.
  float excess;
  float discs_decide;  ///< 1 where a leaf of the deepest cut has no segments, else 0
  Sector sectors[profile_sectors];
};
static_assert(sizeof(Profile) == (1 + profile_sectors) * sizeof(Sector) && sizeof(Sector) == 16);

/// Represents a closed polygon of an outline.
struct Contour {
  Disc disc;  ///< the smallest enclosing one
  std::uint32_t begin,
      end;  ///< its points; after the last one the first follows again, as the end of the last segment
};
static_assert(sizeof(Contour) == 20);

/// Holds the contours of a shape.
struct ContourRange {
  std::uint32_t begin, end;
};

/// Holds the nodes of all shapes and levels as plain pointers: what kernels read. Valid while the set lives.
/// Roots:   index shape * level_count + level.
struct ShapeSetView {
  std::uint32_t shape_count;
  std::uint32_t level_count;
  bool rows_in_order;  ///< root r has row first_row + r: one level, and no cut is a single disc

  const std::uint32_t* depths;  ///< a level
  const Root* roots;
  const Tree* trees;   ///< like roots; this and the next null where every level is a single disc
  const float* nodes;  ///< of all levels; see Tree
  const float* reach;  ///< per shape, metres, rounded up; null like the trees

  // Null without the plan's culling data.
  const float* support;        ///< rows of support_stride floats; those before first_row are infinite
  const DiscBlock* inscribed;  ///< per shape; see interior.hpp
  const Profile* profiles;     ///< per shape

  // Null without the plan's outlines, and like the trees.
  const ContourRange* shape_contours;  ///< per shape
  const Contour* contours;
  const Vec2* points;
  const std::uint32_t* leaf_segments;  ///< words and lists, see Tree::segments; null where no tree has any
  const float* segment_margin;         ///< per shape, metres; see rounding.hpp, V; null without outlines

  const Heights* heights;  ///< per shape; null without the plan's heights
};

}  // namespace bch::detail
