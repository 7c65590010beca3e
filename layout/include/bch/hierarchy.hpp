// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/geometry.hpp>
#include <bch/outline.hpp>

namespace bch {

/// Stands for the depth of a cut that has no limit: its discs are the leaves.
constexpr std::uint32_t all_depths = 0xffffffff;

/// Holds a bounding cylinder hierarchy of one shape: a binary tree of discs on the ground.
/// Source:  Stuvel, Magnenat-Thalmann, Thalmann, Egges, van der Stappen, "Hierarchical structures for
///          collision checking between virtual characters", Computer Animation and Virtual Worlds 25, 2014.
struct Hierarchy {
  /// Represents a primitive that a hierarchy encloses: a triangle, or a segment (c equals b), or a point (all
  /// equal).
  struct Primitive {
    Vec2 a, b, c;
  };

  /// Represents a node of the binary tree, whose nodes are in depth-first order.
  /// The first child of an inner node is the next node.
  struct Node {
    /// Encloses the node's primitives: the smallest such disc, enlarged only by what rounding needs.
    /// It need not enclose the discs of the nodes below.
    Disc disc;
    std::uint32_t second_child = 0;  ///< 0: a leaf

    bool is_leaf() const { return second_child == 0; }
  };

  /// Holds the index range of a node's primitives, which follow each other.
  struct Range {
    std::uint32_t begin, end;
  };

  std::vector<Node> nodes;  ///< the root first; never empty
  double reach = 0;         ///< metres: largest distance of a primitive's point from the origin

  // The primitives of nodes. Exact leaves need them; builders leave them empty unless they are requested.
  std::vector<Primitive> primitives;  ///< in the order of the leaves
  std::vector<std::uint32_t>
      source;  ///< per primitive: index of the outline segment or triangle it comes from
  std::vector<Range> primitive_ranges;  ///< per node: its primitives
  bool of_segments = false;  ///< the primitives are an outline's segments or pieces of them, not triangles
};
static_assert(sizeof(Hierarchy::Node) == 16);

/// Checks what other functions rely on.
/// That is at least one node, children after their parents, finite discs with a radius above 0 and a centre
/// within the reach, and a reach of 1e-6 to 1e6 m.
/// Errors:  throws std::invalid_argument naming the node and the value.
void validate(const Hierarchy& hierarchy);

/// Builds the paper's contour hierarchy. A line splits a node's segments: perpendicular to their longer
/// extent, through their length-weighted centroid. A segment goes to the side of its midpoint. If a side is
/// empty, the other axis is tried, then the segments are halved by count. A lone segment longer than twice
/// the threshold is halved. A node is a leaf if its smallest enclosing disc has a radius below the threshold,
/// or if it is a lone segment.
/// Units:   metres; the threshold is positive and finite.
/// Returns: the hierarchy with its primitives.
/// Errors:  throws std::invalid_argument on a bad outline or threshold, std::length_error beyond 2^22 nodes.
Hierarchy contour_hierarchy(const Outline& outline, float threshold);

/// Returns the nodes at a depth and the leaves above it, in depth-first order: a covering of the shape.
/// Depth 0 is the single cylinder; all_depths selects the leaves.
std::vector<std::uint32_t> cut(const Hierarchy& hierarchy, std::uint32_t depth);

}  // namespace bch
