// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/cut_lists.hpp"

#include <cmath>

#include "layout/rounding.hpp"

namespace bch::baselines {

CutLists::CutLists(std::span<const Shape> shapes, const ShapeSetPlan& plan)
    : level_count_(plan.depths.size()) {
  for (const Shape& shape : shapes) {
    reach_.push_back(rounding::round_up(shape.hierarchy.reach));
    for (const std::uint32_t depth : plan.depths) {
      std::vector<Disc>& list = lists_.emplace_back();
      for (const std::uint32_t node : cut(shape.hierarchy, depth))
        list.push_back(shape.hierarchy.nodes[node].disc);
    }
  }
}

std::span<const Disc> CutLists::of(const Agents& agents, std::uint32_t agent) const {
  return lists_[agents.root(agent, level_count_)];
}

float CutLists::reach(const Agents& agents, std::uint32_t agent) const {
  const std::span<const Disc> discs = of(agents, agent);
  if (discs.size() > 1) return reach_[agents.shape[agent]];
  return std::abs(discs[0].x) + std::abs(discs[0].y) + discs[0].radius;
}

}  // namespace bch::baselines
