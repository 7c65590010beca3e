// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/outline/grid_geometry.hpp"
#include "layout/outline/segment_boxes.hpp"
#include "layout/outline/segment_search.hpp"
#include "layout/outline/topology.hpp"

namespace bch::detail {

/// Holds segments that may be part of an outline, and boxes around the segments for searching. Each segment has the
/// number of its component: the triangles of the mesh that are connected by shared vertices (OutlineTopology::component).
class CandidateList {
 public:
  /// Begins an empty list with capacity for this many segments.
  void begin(std::size_t capacity);
  /// Adds a segment unless it is a point. A segment is always written, so that no branch is needed; if it is a point,
  /// the next one overwrites it. A GridPoint is moved through memory as one 64-bit value, which is fastest.
  void add(GridPoint a, GridPoint b, std::uint32_t component) {
    const auto from = std::bit_cast<std::uint64_t>(a), to = std::bit_cast<std::uint64_t>(b);
    segments_[count_] = {std::bit_cast<GridPoint>(from), std::bit_cast<GridPoint>(to)};
    components_[count_] = component;
    count_ += from != to;
  }
  /// Ends the list; `component_points` has one point of each component.
  void finish(std::span<const GridPoint> component_points);

  std::span<const Segment> segments() const { return {segments_.data(), count_}; }  ///< none is a point
  std::size_t capacity() const {
    return segments_.size();
  }  ///< the allocated length: the requested capacity and one more SIMD block
  std::uint32_t component(std::size_t segment) const { return components_[segment]; }
  std::span<const GridPoint> component_points() const { return component_points_; }
  const SegmentBoxes& boxes() const { return boxes_; }

 private:
  std::vector<Segment> segments_;  ///< capacity and one block more; so has components_
  std::vector<std::uint32_t> components_;
  std::vector<GridPoint> component_points_;
  std::size_t count_ = 0;
  SegmentBoxes boxes_;
};

/// Finds the edges of a pose that may be part of its outline. Points inside an edge with triangles on both sides are
/// inside the union, so only edges whose triangles all lie on one side are candidates. (A triangle seen edge-on, or
/// nearly so, lies on neither side.) Additional edges inside the union would do no harm.
class OutlineCandidates {
 public:
  OutlineCandidates(const OutlineTopology& topology, const OutlineLoops& loops);

  /// Finds the candidates of the pose in which vertex i is at points[i]. Allocates nothing.
  void find(const OutlineTopology& topology, std::span<const GridPoint> points, CandidateList& list);

 private:
  using EdgeUses = std::span<const OutlineTopology::EdgeUse>;

  void find_sides(std::span<const GridPoint> points);
  std::span<const std::uint32_t> choose(const OutlineTopology& topology);
  void add_uses(std::span<const GridPoint> points, EdgeUses uses, const OutlineTopology& topology,
                CandidateList& list) const;

  const OutlineLoops* loops_;
  std::vector<std::array<std::uint32_t, 3>>
      triangles_;                      ///< padded by degenerate triangles to a multiple of triangles_together
  std::vector<std::uint8_t> sides_;    ///< of each triangle
  std::vector<std::uint32_t> chosen_;  ///< indices of the manifold edges that are candidates
  std::vector<GridPoint> component_points_;
};

}  // namespace bch::detail
