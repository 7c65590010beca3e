// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/shapes.hpp>

#include "baselines/placement.hpp"

namespace bch::baselines {

/// Returns whether two segments come within a margin of each other. It computes in double with the operations
/// of layout/base/rounding.hpp, V, in their order. It is written independently of the kernel, which has to
/// give the same bits.
bool segments_meet(std::array<Point2, 2> p, std::array<Point2, 2> q, double margin) noexcept;

/// Returns how far apart two segments are, metres, less the margin and what kernel/distance/segment_gaps.hpp takes off; not below 0.
float segment_gap(std::array<Point2, 2> p, std::array<Point2, 2> q, double margin) noexcept;

/// Represents exact leaves, straight from outlines and hierarchies. The class finds which segments the leaves
/// of shapes hold, and whether those of two leaves meet.
class LeafSegments {
 public:
  /// Takes shapes and a plan as a ShapeSet does. The shapes must outlive this.
  LeafSegments(std::span<const Shape> shapes, const ShapeSetPlan& plan, Leaves leaves);

  /// Returns whether segments decide if leaves of a pair of agents overlap.
  bool decide(const Agents& agents, Pair pair) const;

  /// Returns a segment of an outline: it leads from the point of that number to the next one of the contour.
  static std::array<Point2, 2> segment(const Outline& outline, std::uint32_t number);
  /// Returns the segments of a leaf, a node of a shape's hierarchy; none where these are too many to decide.
  static std::vector<std::array<Point2, 2>> segments_of(const Shape& shape, std::uint32_t node);
  /// Returns a shape's part of the margin within which segments meet, metres.
  static double margin_of(const Shape& shape);

  /// Returns whether segments of two leaves meet. The leaves are nodes of the hierarchies of the agent with
  /// the lower index (`node_a`) and of the other agent (`node_b`).
  /// Precondition: decide().
  bool meet(const FloatPlacement& place, const Agents& agents, Pair pair, std::uint32_t node_a,
            std::uint32_t node_b) const;

 private:
  std::span<const Shape> shapes_;
  std::size_t level_count_;
  std::vector<std::uint8_t> exact_;  ///< shape * level_count_ + level: has segments
};

}  // namespace bch::baselines
