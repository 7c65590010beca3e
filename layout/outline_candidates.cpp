// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline_candidates.hpp"

namespace bch {
namespace {

using ManifoldEdge = OutlineTopology::ManifoldEdge;

/// Whether each triangle's corners go round counter-clockwise (1), clockwise (-1) or are on a line (0).
void find_sides(std::span<const std::array<std::uint32_t, 3>> triangles, const GridPoint* points,
                std::int8_t* sides) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const std::int64_t area = cross(points[b] - points[a], points[c] - points[a]);
    sides[t] = static_cast<std::int8_t>((area > 0) - (area < 0));
  }
}

/// Writes the numbers of the edges that do not have a triangle on either side. Without a branch: one that is
/// not accepted is overwritten by the next.
std::size_t choose(std::span<const ManifoldEdge> edges, const std::int8_t* sides, std::uint32_t* chosen) {
  std::size_t count = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    chosen[count] = e;
    count += sides[edges[e].first] * sides[edges[e].second] <= 0;
  }
  return count;
}

}  // namespace

OutlineCandidates::OutlineCandidates(const OutlineTopology& topology)
    : sides_(topology.triangles.size()),
      chosen_(topology.manifold.size() + 1),
      segments_(topology.manifold.size() + topology.uses.size() + 1),
      vertices_(segments_.size()) {
  boxes_.reserve(segments_.size());
}

void OutlineCandidates::find(const OutlineTopology& topology, std::span<const GridPoint> points) {
  find_sides(topology.triangles, points.data(), sides_.data());
  count_ = 0;
  const std::size_t chosen = choose(topology.manifold, sides_.data(), chosen_.data());
  for (std::size_t i = 0; i < chosen; ++i) {
    const ManifoldEdge& edge = topology.manifold[chosen_[i]];
    add(points, edge.a, edge.b);
  }
  const auto& begin = topology.uses_begin;
  for (std::size_t e = 0; e + 1 < begin.size(); ++e)
    add_uses(points, std::span(topology.uses).subspan(begin[e], begin[e + 1] - begin[e]));
  boxes_.assign(segments());
}

void OutlineCandidates::add(std::span<const GridPoint> points, std::uint32_t a, std::uint32_t b) {
  segments_[count_] = {points[a], points[b]};
  vertices_[count_] = a;
  count_ += !(points[a] == points[b]);
}

/// Where welded vertices are apart, each use is an edge of its own.
void OutlineCandidates::add_uses(std::span<const GridPoint> points,
                                 std::span<const OutlineTopology::EdgeUse> uses) {
  bool together = true, left = false, right = false;
  for (const auto& use : uses) {
    together &= points[use.a] == points[uses[0].a] && points[use.b] == points[uses[0].b];
    left |= sides_[use.triangle] * use.direction > 0;
    right |= sides_[use.triangle] * use.direction < 0;
  }
  if (!together) {
    for (const auto& use : uses) add(points, use.a, use.b);
  } else if (!(left && right)) {
    add(points, uses[0].a, uses[0].b);
  }
}

}  // namespace bch
