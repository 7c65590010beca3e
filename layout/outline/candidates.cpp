// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/candidates.hpp"

#include <algorithm>
#include <bit>

namespace bch::detail {
namespace {

/// The orientation of a triangle seen from above; 0: it is seen edge-on, or nearly.
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

/// The sides of an edge, by its first use's direction, that a use's triangle is on; none where that is seen edge-on.
int sides_of(const OutlineTopology::EdgeUse& use, int side) {
  return use.direction > 0 || side == 0 ? side : side ^ (counter_clockwise | clockwise);
}

}  // namespace

void CandidateList::begin(std::size_t capacity) {
  count_ = 0;
  if (segments_.size() >= capacity + boxes_per_block) return;
  components_.resize(capacity + boxes_per_block);
  boxes_.reserve(capacity + boxes_per_block);
  segments_.resize(capacity + boxes_per_block);  // the last one, which tells that the others have room
}

void CandidateList::finish(std::span<const GridPoint> component_points) {
  component_points_.assign(component_points.begin(), component_points.end());
  if (count_ == 0) return;
  std::fill_n(segments_.begin() + static_cast<std::ptrdiff_t>(count_), boxes_per_block - 1,
              segments_[count_ - 1]);
  boxes_.assign(segments_.data(), count_);
}

OutlineCandidates::OutlineCandidates(const OutlineTopology& topology, const OutlineLoops& loops)
    : loops_(&loops), triangles_(topology.triangles), chosen_(topology.manifold.size() + 1) {
  while (triangles_.size() % triangles_together != 0) triangles_.push_back({0, 0, 0});
  sides_.resize(triangles_.size());
}

void OutlineCandidates::find_sides(std::span<const GridPoint> points) {
  loops_->find_sides(triangles_.data()->data(), triangles_.size(), points.data(), sides_.data());
}

std::span<const std::uint32_t> OutlineCandidates::choose(const OutlineTopology& topology) {
  return std::span(chosen_).first(detail::choose(topology.manifold_triangles, sides_.data(), chosen_.data()));
}

void OutlineCandidates::find(const OutlineTopology& topology, std::span<const GridPoint> points,
                             CandidateList& list) {
  find_sides(points);
  list.begin(topology.manifold.size() + topology.uses.size());
  for (const std::uint32_t e : choose(topology)) {
    const auto& [a, b] = topology.manifold[e];
    list.add(points[a], points[b], topology.component[a]);
  }
  for (std::size_t e = 0; e < topology.edges_of_uses(); ++e)
    add_uses(points, topology.uses_of(e), topology, list);
  component_points_.clear();
  for (const std::uint32_t v : topology.component_vertex) component_points_.push_back(points[v]);
  list.finish(component_points_);
}

/// Adds an edge's uses. If welded vertices are apart, each use is an edge of its own.
void OutlineCandidates::add_uses(std::span<const GridPoint> points, EdgeUses uses,
                                 const OutlineTopology& topology, CandidateList& list) const {
  bool together = true;
  int sides = 0;  // sides of the edge that have triangles
  for (const auto& use : uses) {
    together &= points[use.a] == points[uses[0].a] && points[use.b] == points[uses[0].b];
    sides |= sides_of(use, sides_[use.triangle]);
  }
  const auto add = [&](const auto& use) {
    list.add(points[use.a], points[use.b], topology.component[use.a]);
  };
  if (!together) {
    for (const auto& use : uses) add(use);
  } else if (sides != (counter_clockwise | clockwise)) {
    add(uses[0]);
  }
}

}  // namespace bch::detail
