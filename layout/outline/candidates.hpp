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

/// Holds segments that may be part of an outline, found through the boxes around them. Each belongs to an island: a connected part
/// of the union, which no contour crosses.
class CandidateList {
 public:
  /// Begins an empty list with room for so many segments.
  void begin(std::size_t capacity);
  /// Adds a segment, unless it is a point. A point that goes through memory is best moved as one value; one that is not wanted
  /// is overwritten by the next.
  void add(GridPoint a, GridPoint b, std::uint32_t island) {
    const auto from = std::bit_cast<std::uint64_t>(a), to = std::bit_cast<std::uint64_t>(b);
    segments_[count_] = {std::bit_cast<GridPoint>(from), std::bit_cast<GridPoint>(to)};
    islands_[count_] = island;
    count_ += from != to;
  }
  /// Takes the islands, and a point of each.
  void finish(std::span<const GridPoint> island_points);

  std::span<const Segment> segments() const { return {segments_.data(), count_}; }  ///< none is a point
  std::size_t capacity() const { return segments_.size(); }  ///< for segments, and a block more
  std::uint32_t island(std::size_t segment) const { return islands_[segment]; }
  std::span<const GridPoint> island_points() const { return island_points_; }
  const SegmentBoxes& boxes() const { return boxes_; }

 private:
  std::vector<Segment> segments_;  ///< and room for a block more, as in the next
  std::vector<std::uint32_t> islands_;
  std::vector<GridPoint> island_points_;
  std::size_t count_ = 0;
  SegmentBoxes boxes_;
};

/// Holds the edges of a pose that may be part of its outline. A point inside an edge with triangles on both sides is
/// inside the union, so only edges whose triangles all lie on one side remain (a triangle seen edge-on, or nearly,
/// lies on none); any further piece of the union may be among them without harm.
class OutlineCandidates {
 public:
  OutlineCandidates(const OutlineTopology& topology, const OutlineLoops& loops);

  /// Finds those of the pose in which vertex i is at points[i]. Allocates nothing.
  void find(const OutlineTopology& topology, std::span<const GridPoint> points, CandidateList& list);

 private:
  using EdgeUses = std::span<const OutlineTopology::EdgeUse>;

  void find_sides(std::span<const GridPoint> points);
  std::span<const std::uint32_t> choose(const OutlineTopology& topology);
  void add_uses(std::span<const GridPoint> points, EdgeUses uses, const OutlineTopology& topology,
                CandidateList& list) const;

  const OutlineLoops* loops_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;  ///< and points that fill them up
  std::vector<std::uint8_t> sides_;                      ///< of each triangle
  std::vector<std::uint32_t> chosen_;                    ///< manifold edges
  std::vector<GridPoint> island_points_;
};

}  // namespace bch::detail
