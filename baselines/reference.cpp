// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/reference.hpp"

#include <algorithm>

#include "baselines/disc_tree.hpp"
#include "baselines/oracle.hpp"

namespace bch::baselines {
namespace {

bool any_overlap(const FloatPlacement& place, std::span<const Disc> a, std::span<const Disc> b) {
  for (const Disc& p : a)
    for (const Disc& q : b)
      if (discs_overlap(place, p, p.radius, q, q.radius)) return true;
  return false;
}

}  // namespace

Reference::Reference(std::span<const Shape> shapes, const ShapeSetPlan& plan)
    : shapes_(shapes), level_count_(static_cast<std::uint32_t>(plan.depths.size())) {
  for (const Shape& shape : shapes) {
    bounds_.push_back(bounding_radii(shape.hierarchy));
    for (const std::uint32_t depth : plan.depths) {
      Level level{depth, height(shape.hierarchy), {}};
      for (const std::uint32_t node : cut(shape.hierarchy, depth))
        level.discs.push_back(shape.hierarchy.nodes[node].disc);
      levels_.push_back(std::move(level));
    }
  }
}

const Reference::Level& Reference::level(const Agents& agents, std::uint32_t agent) const {
  return levels_[agents.root(agent, level_count_)];
}

bool Reference::boundary(const Agents& agents, Pair pair, Method method) const {
  const auto [a, b] = std::minmax(pair.first, pair.second);
  const FloatPlacement place = float_placement(agents, pair);
  const Level &level_a = level(agents, a), &level_b = level(agents, b);
  if (method == Method::brute_force) return any_overlap(place, level_a.discs, level_b.discs);
  const auto tree = [&](std::uint32_t agent, const Level& at) {
    const std::uint32_t shape = agents.shape[agent];
    return DiscTree{shapes_[shape].hierarchy.nodes.data(), bounds_[shape].data(), at.depth, at.height};
  };
  return any_ends_overlap(place, tree(a, level_a), tree(b, level_b), NoCounts{},
                          [](const NodePair&) { return true; });
}

bool Reference::solid(const Agents& agents, Pair pair, Method method) const {
  if (boundary(agents, pair, method)) return true;
  const auto [a, b] = pair;
  return Oracle(shapes_[agents.shape[a]].outline, shapes_[agents.shape[b]].outline,
                exact_placement(agents, a, b))
      .nested();
}

}  // namespace bch::baselines
