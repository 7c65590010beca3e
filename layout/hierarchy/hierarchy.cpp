// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/hierarchy.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

namespace bch {

using namespace detail;

namespace {

[[noreturn]] void reject(const Hierarchy& hierarchy, std::size_t i) {
  const auto& [disc, second] = hierarchy.nodes[i];
  throw std::invalid_argument("hierarchy: node " + std::to_string(i) + ": a disc of " +
                              shortest(disc.radius) + " m at (" + shortest(disc.x) + ", " + shortest(disc.y) +
                              ") m, second child " + std::to_string(second) + " of " +
                              std::to_string(hierarchy.nodes.size()) + " nodes");
}

}  // namespace

void validate(const Hierarchy& hierarchy) {
  const FloatingPointStateGuard floats;
  if (hierarchy.nodes.empty()) throw std::invalid_argument("hierarchy: it has no nodes");
  require_extent(hierarchy.max_extent);
  const auto farthest = static_cast<float>(hierarchy.max_extent * (1 + 0x1p-20));
  const std::size_t count = hierarchy.nodes.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Hierarchy::Node& node = hierarchy.nodes[i];
    const bool is_near = (std::abs(node.disc.x) <= farthest) & (std::abs(node.disc.y) <= farthest);
    const bool has_radius = (node.disc.radius > 0) & (node.disc.radius <= std::numeric_limits<float>::max());
    const bool has_children = node.is_leaf() | ((node.second_child > i + 1) & (node.second_child < count));
    if (!(is_near & has_radius & has_children)) reject(hierarchy, i);
  }
}

Hierarchy contour_hierarchy(const Outline& outline, float threshold) {
  return detail::contour_hierarchy(outline, threshold, SplitRule::centroid);
}

std::vector<std::uint32_t> cut(const Hierarchy& hierarchy, std::uint32_t depth) {
  std::vector<std::uint32_t> nodes;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open = {{0, 0}};  // node, depth
  while (!open.empty()) {
    const auto [index, level] = open.back();
    open.pop_back();
    const Hierarchy::Node& node = hierarchy.nodes[index];
    if (node.is_leaf() || level == depth) {
      nodes.push_back(index);
      continue;
    }
    open.push_back({node.second_child, level + 1});
    open.push_back({index + 1, level + 1});
  }
  return nodes;
}

}  // namespace bch

namespace bch::detail {

Hierarchy contour_hierarchy(const Outline& outline, float threshold, SplitRule rule) {
  const FloatingPointStateGuard floats;
  Hierarchy hierarchy;
  HierarchyBuilder builder;
  builder.contour(outline, threshold, rule, hierarchy);
  builder.add_primitives(hierarchy);
  return hierarchy;
}

Hierarchy projected_hierarchy(std::span<const Vec2> vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles) {
  const FloatingPointStateGuard floats;
  Hierarchy hierarchy;
  HierarchyBuilder builder;
  builder.projected(vertices, triangles, hierarchy);
  builder.add_primitives(hierarchy);
  return hierarchy;
}

Hierarchy fixed_cylinder(float radius) {
  const FloatingPointStateGuard floats;
  const double size = radius;
  require_extent(size);
  Hierarchy hierarchy;
  hierarchy.max_extent = size;
  Hierarchy::Node root;
  root.disc = {0, 0, rounding::round_up(size * (1 + rounding::query_margin))};
  hierarchy.nodes.push_back(root);
  return hierarchy;
}

std::uint32_t height(const Hierarchy& hierarchy) {
  std::vector<std::uint32_t> depth(hierarchy.nodes.size());
  std::uint32_t deepest = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    deepest = std::max(deepest, depth[i]);
    if (hierarchy.nodes[i].is_leaf()) continue;
    depth[i + 1] = depth[hierarchy.nodes[i].second_child] = depth[i] + 1;
  }
  return deepest;
}

}  // namespace bch::detail
