// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/topology.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

#include "layout/base/number_class.hpp"

namespace bch::detail {
namespace {

using EdgeUse = OutlineTopology::EdgeUse;
using Triangles = std::span<const std::array<std::uint32_t, 3>>;
using Positions = std::span<const Vec3>;

constexpr std::uint32_t unused = 0xffffffff;

/// Fills used and triangles.
void number_anew(Triangles triangles, std::size_t vertices, OutlineTopology& topology) {
  if (triangles.empty()) throw std::invalid_argument("outline: no triangles");
  std::vector<std::uint32_t> number(vertices, unused);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t]) {
      if (v >= vertices)
        throw std::invalid_argument("outline: triangle " + std::to_string(t) + " names vertex " +
                                    std::to_string(v));
      number[v] = 0;
    }
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (number[v] == unused) continue;
    number[v] = static_cast<std::uint32_t>(topology.used.size());
    topology.used.push_back(v);
  }
  for (const auto& [a, b, c] : triangles) topology.triangles.push_back({number[a], number[b], number[c]});
}

std::vector<Vec3> used_positions(Positions bind_pose, std::span<const std::uint32_t> used) {
  std::vector<Vec3> positions;
  for (const std::uint32_t v : used) {
    const Vec3& at = bind_pose[v];
    if (!is_finite(at.x) || !is_finite(at.y) || !is_finite(at.z))
      throw std::invalid_argument("outline: vertex " + std::to_string(v) + " of the bind pose is not finite");
    positions.push_back(at);
  }
  return positions;
}

/// Finds for each vertex the first at the same position.
std::vector<std::uint32_t> welded(Positions positions, std::size_t vertices) {
  std::vector<std::uint32_t> weld(vertices);
  std::iota(weld.begin(), weld.end(), 0u);
  if (positions.empty()) return weld;
  const auto key = [&](std::uint32_t v) {
    return std::tuple(positions[v].x, positions[v].y, positions[v].z);
  };
  std::vector<std::uint32_t> order = weld;
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t v, std::uint32_t w) { return std::pair(key(v), v) < std::pair(key(w), w); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1])) weld[order[i]] = weld[order[i - 1]];
  return weld;
}

/// An edge: all triangles' uses of it, and where it is.
struct Edge {
  std::span<EdgeUse> uses;
  std::array<float, 3> middle;
};

std::array<float, 3> middle_of(const Vec3& a, const Vec3& b) {
  return {0.5f * a.x + 0.5f * b.x, 0.5f * a.y + 0.5f * b.y, 0.5f * a.z + 0.5f * b.z};
}

bool manifold(std::span<const EdgeUse> uses) {
  return uses.size() == 2 && uses[0].a == uses[1].a && uses[0].b == uses[1].b &&
         uses[0].direction != uses[1].direction;
}

/// Sorts uses by their ends, those of a welded vertex first of all: a vertex has few.
std::vector<EdgeUse> sorted(std::span<const EdgeUse> uses, std::span<const std::uint32_t> weld) {
  std::vector<std::size_t> begin(weld.size() + 1, 0);
  for (const EdgeUse& use : uses) ++begin[weld[use.a] + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<EdgeUse> result(uses.size());
  std::vector<std::size_t> next = begin;
  for (const EdgeUse& use : uses) result[next[weld[use.a]]++] = use;
  const auto key = [&](const EdgeUse& use) {
    return std::tuple(weld[use.b], use.a, use.b, use.triangle, use.direction);
  };
  for (std::size_t v = 0; v < weld.size(); ++v)
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(begin[v]),
              result.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]),
              [&](const EdgeUse& a, const EdgeUse& b) { return key(a) < key(b); });
  return result;
}

/// The triangles' uses of their edges, those of an edge together. Ends that are one vertex are no edge.
std::vector<EdgeUse> edge_uses(Triangles triangles, std::span<const std::uint32_t> weld) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      if (from == to) continue;
      const bool forward = std::tie(weld[from], from) < std::tie(weld[to], to);
      uses.push_back(forward ? EdgeUse{from, to, t, 1} : EdgeUse{to, from, t, -1});
    }
  return sorted(uses, weld);
}

std::vector<Edge> edges_of(std::vector<EdgeUse>& uses, std::span<const std::uint32_t> weld,
                           Positions positions) {
  std::vector<Edge> edges;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    const auto [a, b, triangle, direction] = uses[begin];
    while (end < uses.size() && weld[uses[end].a] == weld[a] && weld[uses[end].b] == weld[b]) ++end;
    edges.push_back({std::span(uses).subspan(begin, end - begin), {}});
    if (!positions.empty()) edges.back().middle = middle_of(positions[a], positions[b]);
  }
  return edges;
}

/// Puts edges near each other next to each other: halves by the longer side of their box, over and over.
void sort_by_place(std::span<Edge> edges) {
  constexpr std::size_t together = 16;
  if (edges.size() <= together) return;
  std::array<float, 3> low = edges[0].middle, high = low, extent;
  for (const Edge& edge : edges)
    for (std::size_t k = 0; k < 3; ++k)
      low[k] = std::min(low[k], edge.middle[k]), high[k] = std::max(high[k], edge.middle[k]);
  for (std::size_t k = 0; k < 3; ++k) extent[k] = high[k] - low[k];
  const auto axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  const auto half = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), half, edges.end(), [axis](const Edge& a, const Edge& b) {
    return std::pair(a.middle[axis], a.uses.data()) < std::pair(b.middle[axis], b.uses.data());
  });
  sort_by_place(edges.first(edges.size() / 2));
  sort_by_place(edges.subspan(edges.size() / 2));
}

/// Fills component and component_vertex.
void find_islands(OutlineTopology& topology) {
  std::vector<std::uint32_t> root(topology.used.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& [a, b, c] : topology.triangles) {
    for (const std::uint32_t other : {b, c}) {
      const std::uint32_t v = find(a), w = find(other);
      root[std::max(v, w)] = std::min(v, w);
    }
  }
  topology.component.resize(root.size());
  for (std::uint32_t v = 0; v < root.size(); ++v) {
    if (find(v) == v) topology.component_vertex.push_back(v);
    const auto newest = static_cast<std::uint32_t>(topology.component_vertex.size() - 1);
    topology.component[v] = find(v) == v ? newest : topology.component[find(v)];
  }
}

}  // namespace

OutlineTopology outline_topology(Triangles triangles, std::size_t vertices, Positions bind_pose) {
  if (!bind_pose.empty() && bind_pose.size() != vertices)
    throw std::invalid_argument("outline: a bind pose of " + std::to_string(bind_pose.size()) +
                                " positions for " + std::to_string(vertices) + " vertices");
  OutlineTopology topology;
  number_anew(triangles, vertices, topology);
  std::vector<Vec3> positions;
  if (!bind_pose.empty()) positions = used_positions(bind_pose, topology.used);

  const std::vector<std::uint32_t> weld = welded(positions, topology.used.size());
  std::vector<EdgeUse> uses = edge_uses(topology.triangles, weld);
  std::vector<Edge> edges = edges_of(uses, weld, positions);
  sort_by_place(edges);
  for (const Edge& edge : edges) {
    if (manifold(edge.uses)) {
      topology.manifold.push_back({edge.uses[0].a, edge.uses[0].b});
      topology.manifold_triangles.push_back({edge.uses[0].triangle, edge.uses[1].triangle});
      continue;
    }
    topology.uses_begin.push_back(static_cast<std::uint32_t>(topology.uses.size()));
    topology.uses.insert(topology.uses.end(), edge.uses.begin(), edge.uses.end());
  }
  topology.uses_begin.push_back(static_cast<std::uint32_t>(topology.uses.size()));
  find_islands(topology);
  return topology;
}

}  // namespace bch::detail
