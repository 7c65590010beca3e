// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/outline/box_tree.hpp"
#include "layout/outline/grid_geometry.hpp"
#include "layout/outline/implementation.hpp"
#include "layout/outline/topology.hpp"

namespace bch::detail {

/// The edges of a pose that may be part of its outline. A point inside an edge with triangles on both sides is
/// inside the union, so only edges whose triangles all lie on one side remain (a triangle seen edge-on, or nearly,
/// lies on none); any further piece of the union may be among them without harm.
class OutlineCandidates {
 public:
  OutlineCandidates(const OutlineTopology& topology, const OutlineImplementation& implementation);

  /// Finds those of the pose in which vertex i is at points[i]. Allocates nothing.
  void find(const OutlineTopology& topology, std::span<const GridPoint> points);

  std::span<const Segment> segments() const { return {segments_.data(), count_}; }  ///< none is a point
  std::uint32_t vertex(std::size_t segment) const { return vertices_[segment]; }    ///< at the segment's a
  const BoxTree& boxes() const { return boxes_; }

 private:
  void add(std::span<const GridPoint> points, std::uint32_t a, std::uint32_t b);
  void add_uses(std::span<const GridPoint> points, std::span<const OutlineTopology::EdgeUse> uses);

  const OutlineImplementation* implementation_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;  ///< and points up to a multiple of four
  std::vector<std::uint8_t> sides_;                      ///< of each triangle
  std::vector<std::uint32_t> chosen_;                    ///< manifold edges
  std::vector<Segment> segments_;                        ///< and room for a block more, as in the next
  std::vector<std::uint32_t> vertices_;
  std::size_t count_ = 0;
  BoxTree boxes_;
};

}  // namespace bch::detail
