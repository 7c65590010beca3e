// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/candidates.hpp"

#include <algorithm>
#include <bit>

namespace bch::detail {
namespace {

constexpr std::uint32_t no_island = 0xffffffff;

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
int seen_beside(const OutlineTopology::EdgeUse& use, int side) {
  return use.direction > 0 || side == 0 ? side : side ^ (counter_clockwise | clockwise);
}

/// Numbers the islands of a slab, whose segments are given by nodes of the cuts.
void number_islands(PlaneCuts& cuts, std::vector<std::uint32_t>& number, CandidateList& list,
                    std::vector<GridPoint>& points) {
  const std::span<std::uint32_t> nodes = list.islands();
  points.clear();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::uint32_t& island = number[cuts.root(nodes[i])];
    if (island == no_island) {
      island = static_cast<std::uint32_t>(points.size());
      points.push_back(list.segments()[i].a);
    }
    nodes[i] = island;
  }
  list.finish(points);
}

}  // namespace

void CandidateList::begin(std::size_t room) {
  count_ = 0;
  if (segments_.size() >= room + boxes_per_block) return;
  islands_.resize(room + boxes_per_block);
  boxes_.reserve(room + boxes_per_block);
  segments_.resize(room + boxes_per_block);  // the last one, which tells that the others have room
}

void CandidateList::finish(std::span<const GridPoint> island_points) {
  island_points_.assign(island_points.begin(), island_points.end());
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
    list.add(points[a], points[b], topology.island[a]);
  }
  for (std::size_t e = 0; e < topology.edges_of_uses(); ++e)
    add_uses(points, topology.uses_of(e), topology, list);
  island_points_.clear();
  for (const std::uint32_t v : topology.island_vertex) island_points_.push_back(points[v]);
  list.finish(island_points_);
}

/// Adds an edge's uses. If welded vertices are apart, each use is an edge of its own.
void OutlineCandidates::add_uses(std::span<const GridPoint> points, EdgeUses uses,
                                 const OutlineTopology& topology, CandidateList& list) const {
  bool together = true;
  int seen = 0;  // sides of the edge that have triangles
  for (const auto& use : uses) {
    together &= points[use.a] == points[uses[0].a] && points[use.b] == points[uses[0].b];
    seen |= seen_beside(use, sides_[use.triangle]);
  }
  const auto add = [&](const auto& use) { list.add(points[use.a], points[use.b], topology.island[use.a]); };
  if (!together) {
    for (const auto& use : uses) add(use);
  } else if (seen != (counter_clockwise | clockwise)) {
    add(uses[0]);
  }
}

/// An edge of a triangle that is cut may be a candidate in one slab and none in another, so that it is looked at in each.
void OutlineCandidates::find(const OutlineTopology& topology, std::span<const GridPoint> points,
                             PlaneCuts& cuts, std::span<CandidateList> slabs) {
  find_sides(points);
  for (const std::uint32_t t : cuts.cut_triangles()) sides_[t] = 0;
  const std::span<const std::uint32_t> chosen = choose(topology);
  for (CandidateList& list : slabs) list.begin(chosen.size() + topology.uses.size() + cuts.borders().size());
  for (const std::uint32_t e : chosen)
    add_edge(topology.manifold[e], topology.manifold_triangles[e], cuts, slabs);
  for (std::size_t e = 0; e < topology.edges_of_uses(); ++e) add_uses(topology.uses_of(e), cuts, slabs);
  for (const auto& [a, b, slab, node] : cuts.borders()) slabs[slab].add(a, b, node);
  numbers_.assign(cuts.nodes(), no_island);
  for (CandidateList& list : slabs) number_islands(cuts, numbers_, list, island_points_);
}

std::uint8_t OutlineCandidates::side_in_slab(std::uint32_t triangle, std::uint32_t slab,
                                             const PlaneCuts& cuts) const {
  return cuts.is_cut(triangle) ? cuts.side(triangle, slab) : sides_[triangle];
}

/// Adds an edge of two triangles in each slab where it is a candidate. Its pieces are connected with those of the triangles.
void OutlineCandidates::add_edge(const OutlineTopology::ManifoldEdge& edge,
                                 const OutlineTopology::EdgeTriangles& triangles, PlaneCuts& cuts,
                                 std::span<CandidateList> slabs) const {
  const auto [a, b] = edge;
  const auto [lowest, highest] = std::minmax({cuts.slab(a), cuts.slab(b)});
  for (std::uint32_t slab = lowest; slab <= highest; ++slab) {
    std::uint32_t node = a;
    if (lowest != highest)
      cuts.connect(node = cuts.node(triangles.first, slab), cuts.node(triangles.second, slab));
    else
      cuts.connect(a, b);
    if ((side_in_slab(triangles.first, slab, cuts) & side_in_slab(triangles.second, slab, cuts)) != 0)
      continue;
    const auto [from, to] = cuts.piece(a, b, slab);
    slabs[slab].add(from, to, node);
  }
}

/// The same for an edge's uses. Uses that are together are at the same heights, too.
void OutlineCandidates::add_uses(EdgeUses uses, PlaneCuts& cuts, std::span<CandidateList> slabs) const {
  bool together = true;
  for (const auto& use : uses)
    together &= cuts.same_place(use.a, uses[0].a) && cuts.same_place(use.b, uses[0].b);
  const auto node_of = [&](const auto& use, std::uint32_t slab) {
    return cuts.slab(use.a) == cuts.slab(use.b) ? use.a : cuts.node(use.triangle, slab);
  };
  const auto for_slabs = [&](const auto& use, auto each) {
    const auto [lowest, highest] = std::minmax({cuts.slab(use.a), cuts.slab(use.b)});
    for (std::uint32_t slab = lowest; slab <= highest; ++slab) each(slab);
  };
  const auto add = [&](const auto& use, std::uint32_t slab) {
    if (cuts.slab(use.a) == cuts.slab(use.b)) cuts.connect(use.a, use.b);
    const auto [from, to] = cuts.piece(use.a, use.b, slab);
    slabs[slab].add(from, to, node_of(use, slab));
  };
  if (!together) {
    for (const auto& use : uses) for_slabs(use, [&](std::uint32_t slab) { add(use, slab); });
    return;
  }
  for_slabs(uses[0], [&](std::uint32_t slab) {
    int seen = 0;
    for (const auto& use : uses) {
      seen |= seen_beside(use, side_in_slab(use.triangle, slab, cuts));
      cuts.connect(node_of(uses[0], slab), node_of(use, slab));
    }
    if (seen != (counter_clockwise | clockwise)) add(uses[0], slab);
  });
}

}  // namespace bch::detail
