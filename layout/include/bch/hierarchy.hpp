// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/geometry.hpp>
#include <bch/outline.hpp>

namespace bch {

/// Selects, as a depth of cut(), the leaves of the tree: this depth is below every node.
constexpr std::uint32_t all_depths = 0xffffffff;

/// Holds a bounding cylinder hierarchy of one shape: a binary tree of discs on the ground.
/// Source:  Stuvel, Magnenat-Thalmann, Thalmann, Egges, van der Stappen, "Hierarchical structures for
///          collision checking between virtual characters", Computer Animation and Virtual Worlds 25, 2014.
struct Hierarchy {
  /// Represents what a hierarchy encloses: a triangle, a segment (c equals b) or a point (all equal).
  struct Primitive {
    Vec2 a, b, c;
  };

  /// Represents a node of the binary tree. Nodes are stored in depth-first order.
  /// The first child of an inner node is the next node.
  struct Node {
    /// The smallest disc that encloses the node's primitives, enlarged only by what rounding needs.
    /// The discs of descendants may protrude from it.
    Disc disc;
    std::uint32_t second_child = 0;  ///< 0: a leaf

    bool is_leaf() const { return second_child == 0; }
  };

  /// Holds the range of indices, from begin to before end, of a node's primitives.
  struct Range {
    std::uint32_t begin, end;
  };

  std::vector<Node> nodes;  ///< the root first; never empty
  double max_extent = 0;    ///< metres: largest distance of a primitive's point from the origin

  // The primitives of the nodes. Exact leaves need them: leaves that queries test by their segments, not by
  // their discs. Without exact leaves, all of these may be empty.
  std::vector<Primitive> primitives;  ///< in the order of the leaves
  /// Per primitive: the index of the outline segment or the triangle that it is, or is a piece of.
  std::vector<std::uint32_t> source;
  std::vector<Range> primitive_ranges;  ///< per node: its primitives
  bool of_segments = false;  ///< primitives are segments of an outline or pieces of these, not triangles
};
static_assert(sizeof(Hierarchy::Node) == 16);

/// Checks what other functions expect of a hierarchy.
/// There is at least one node, children follow their parents, discs are finite with a radius above 0 and a
/// centre within the extent, and the extent is 1e-6 to 1e6 m.
/// Errors:  throws std::invalid_argument naming the node and the value.
void validate(const Hierarchy& hierarchy);

/// Builds the paper's contour hierarchy.
/// A node's segments are split by a line through their length-weighted centroid, perpendicular to the axis of
/// their larger extent; a segment goes to the side of its midpoint. If a side stays empty, the other axis is
/// tried, then the segments are halved by count. A node of one segment is halved if the segment is longer
/// than twice the threshold; else it is a leaf. Any other node is a leaf if the radius of its disc is below
/// the threshold.
/// Units:   metres; the threshold is positive and finite. The result includes `primitives`.
/// Errors:  throws std::invalid_argument on a bad outline or threshold, std::length_error beyond 2^22 nodes.
Hierarchy contour_hierarchy(const Outline& outline, float threshold);

/// Returns the nodes at a depth and the leaves above it, in depth-first order. Together they cover the shape.
/// Depth 0 is the single cylinder; all_depths selects the leaves.
std::vector<std::uint32_t> cut(const Hierarchy& hierarchy, std::uint32_t depth);

}  // namespace bch
