// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/candidates.hpp"

#include <algorithm>
#include <bit>

namespace bch::detail {
namespace {

using ManifoldEdge = OutlineTopology::ManifoldEdge;

constexpr std::uint8_t counter_clockwise = 1, clockwise = 2;

/// Writes the numbers of the edges that do not have a triangle on either side. Without a branch: one that is
/// not accepted is overwritten by the next. Four at a time, and both triangles in one load, because this loop runs
/// at the pace of its instructions.
std::size_t choose(std::span<const OutlineTopology::EdgeTriangles> edges, const std::uint8_t* sides,
                   std::uint32_t* chosen) {
  std::size_t count = 0;
  const auto offer = [&](std::size_t e) {
    const auto both = std::bit_cast<std::uint64_t>(edges[e]);
    chosen[count] = static_cast<std::uint32_t>(e);
    count += (sides[static_cast<std::uint32_t>(both)] & sides[both >> 32]) == 0;
  };
  std::size_t e = 0;
  for (; e + 3 < edges.size(); e += 4) offer(e), offer(e + 1), offer(e + 2), offer(e + 3);
  for (; e < edges.size(); ++e) offer(e);
  return count;
}

}  // namespace

OutlineCandidates::OutlineCandidates(const OutlineTopology& topology,
                                     const OutlineImplementation& implementation)
    : implementation_(&implementation),
      triangles_(topology.triangles),
      chosen_(topology.manifold.size() + 1),
      segments_(topology.manifold.size() + topology.uses.size() + boxes_per_block),
      vertices_(segments_.size()) {
  while (triangles_.size() % 4 != 0) triangles_.push_back({0, 0, 0});
  sides_.resize(triangles_.size());
  boxes_.reserve(segments_.size());
}

/// A point that goes through memory is best moved as one value. An edge that is a point is overwritten by the
/// next.
inline void OutlineCandidates::add(std::span<const GridPoint> points, std::uint32_t a, std::uint32_t b) {
  const auto from = std::bit_cast<std::uint64_t>(points[a]), to = std::bit_cast<std::uint64_t>(points[b]);
  segments_[count_] = {std::bit_cast<GridPoint>(from), std::bit_cast<GridPoint>(to)};
  vertices_[count_] = a;
  count_ += from != to;
}

void OutlineCandidates::find(const OutlineTopology& topology, std::span<const GridPoint> points) {
  implementation_->find_sides(triangles_.data()->data(), triangles_.size(), points.data(), sides_.data());
  const std::size_t chosen = choose(topology.manifold_triangles, sides_.data(), chosen_.data());
  count_ = 0;
  for (std::size_t i = 0; i < chosen; ++i) {
    const ManifoldEdge& edge = topology.manifold[chosen_[i]];
    add(points, edge.a, edge.b);
  }
  const auto& begin = topology.uses_begin;
  for (std::size_t e = 0; e + 1 < begin.size(); ++e)
    add_uses(points, std::span(topology.uses).subspan(begin[e], begin[e + 1] - begin[e]));
  if (count_ == 0) return;
  std::fill_n(segments_.begin() + static_cast<std::ptrdiff_t>(count_), boxes_per_block - 1,
              segments_[count_ - 1]);
  boxes_.assign(segments_.data(), count_);
}

/// Adds an edge's uses. If welded vertices are apart, each use is an edge of its own.
void OutlineCandidates::add_uses(std::span<const GridPoint> points,
                                 std::span<const OutlineTopology::EdgeUse> uses) {
  bool together = true;
  int seen = 0;  // sides of the edge that have triangles
  for (const auto& use : uses) {
    together &= points[use.a] == points[uses[0].a] && points[use.b] == points[uses[0].b];
    const int side = sides_[use.triangle];
    seen |= use.direction > 0 || side == 0 ? side : side ^ (counter_clockwise | clockwise);
  }
  if (!together) {
    for (const auto& use : uses) add(points, use.a, use.b);
  } else if (seen != (counter_clockwise | clockwise)) {
    add(points, uses[0].a, uses[0].b);
  }
}

}  // namespace bch::detail
