// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline_candidates.hpp"

#include <bit>

namespace bch {
namespace {

using ManifoldEdge = OutlineTopology::ManifoldEdge;

constexpr std::uint8_t counter_clockwise = 1, clockwise = 2;

/// A point's coordinates in a register; GCC's and Clang's vector types are in any target's
/// baseline.
using Pair [[gnu::vector_size(8)]] = std::int32_t;
using WidePair [[gnu::vector_size(16)]] = double;

/// Which way each triangle's corners go round; 0 where they are on a line. The products of the determinant are
/// exact in double (grid_geometry.hpp), so they need not be subtracted to be compared.
void find_sides(std::span<const std::array<std::uint32_t, 3>> triangles, const GridPoint* points,
                std::uint8_t* sides) {
  const auto load = [points](std::uint32_t v) { return std::bit_cast<Pair>(points[v]); };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const WidePair u = __builtin_convertvector(load(b) - load(a), WidePair);
    const WidePair v = __builtin_convertvector(load(c) - load(a), WidePair);
    const WidePair products = u * __builtin_shufflevector(v, v, 1, 0);
    sides[t] = static_cast<std::uint8_t>((products[0] > products[1] ? counter_clockwise : 0) |
                                         (products[0] < products[1] ? clockwise : 0));
  }
}

/// Writes the numbers of the edges that do not have a triangle on either side. Without a branch: one that is
/// not accepted is overwritten by the next.
std::size_t choose(std::span<const ManifoldEdge> edges, const std::uint8_t* sides, std::uint32_t* chosen) {
  std::size_t count = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    chosen[count] = e;
    count += (sides[edges[e].first] & sides[edges[e].second]) == 0;
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

}  // namespace bch
