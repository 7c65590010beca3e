// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/cut_tree.hpp"

#include "layout/base/rounding.hpp"
#include "layout/hierarchy/subtrees.hpp"

namespace bch::baselines {
namespace {

/// Appends what a hierarchy has below a node, down to a depth.
void add(const Hierarchy& hierarchy, const std::vector<float>& bounds, std::uint32_t node,
         std::uint32_t depth, CutTrees::Tree& tree) {
  const Hierarchy::Node& at = hierarchy.nodes[node];
  if (depth == 0 || at.is_leaf()) {
    const auto index = static_cast<std::uint32_t>(tree.discs.size());
    tree.nodes.push_back({at.disc.x, at.disc.y, at.disc.radius, CutTrees::Node::is_leaf + index});
    tree.discs.push_back(at.disc);
    return;
  }
  const std::size_t here = tree.nodes.size();
  tree.nodes.push_back({at.disc.x, at.disc.y, bounds[node], 0});
  add(hierarchy, bounds, node + 1, depth - 1, tree);
  tree.nodes[here].link = static_cast<std::uint32_t>(tree.nodes.size());
  add(hierarchy, bounds, at.second_child, depth - 1, tree);
}

}  // namespace

CutTrees::CutTrees(std::span<const Shape> shapes, const ShapeSetPlan& plan)
    : level_count_(static_cast<std::uint32_t>(plan.depths.size())) {
  for (const Shape& shape : shapes) {
    const std::vector<float> bounds = detail::bounding_radii(shape.hierarchy);
    for (const std::uint32_t depth : plan.depths) {
      Tree& tree = trees_.emplace_back();
      tree.max_extent = detail::rounding::round_up(shape.hierarchy.max_extent);
      add(shape.hierarchy, bounds, 0, depth, tree);
    }
  }
}

const CutTrees::Tree& CutTrees::tree(const Agents& agents, std::uint32_t agent) const {
  return trees_[agents.root(agent, level_count_)];
}

}  // namespace bch::baselines
