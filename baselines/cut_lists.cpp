// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/cut_lists.hpp"

#include <algorithm>
#include <cmath>

#include "baselines/disc_tree.hpp"
#include "layout/base/rounding.hpp"

namespace bch::baselines {
namespace {

CutList list_of(const Hierarchy& hierarchy, std::uint32_t depth) {
  CutList list{{}, cut(hierarchy, depth), {}, {0}};
  for (const std::uint32_t node : list.nodes) {
    const std::vector<Disc> path = path_to(hierarchy.nodes.data(), node);
    list.discs.push_back(path.front());
    list.paths.insert(list.paths.end(), path.begin(), path.end());
    list.path_begin.push_back(static_cast<std::uint32_t>(list.paths.size()));
  }
  return list;
}

}  // namespace

bool any_hit(const FloatPlacement& place, const CutList& a, const CutList& b) {
  for (std::size_t i = 0; i < a.discs.size(); ++i)
    for (std::size_t j = 0; j < b.discs.size(); ++j)
      if (all_overlap(place, a.path(i), b.path(j))) return true;
  return false;
}

CutLists::CutLists(std::span<const Shape> shapes, const ShapeSetPlan& plan)
    : level_count_(plan.depths.size()) {
  for (const Shape& shape : shapes) {
    max_extent_.push_back(detail::rounding::round_up(shape.hierarchy.max_extent));
    for (const std::uint32_t depth : plan.depths) lists_.push_back(list_of(shape.hierarchy, depth));
  }
}

const CutList& CutLists::list(const Agents& agents, std::uint32_t agent) const {
  return lists_[agents.root(agent, level_count_)];
}

std::span<const Disc> CutLists::of(const Agents& agents, std::uint32_t agent) const {
  return list(agents, agent).discs;
}

float CutLists::max_extent(const Agents& agents, std::uint32_t agent) const {
  const std::span<const Disc> discs = of(agents, agent);
  if (discs.size() > 1) return max_extent_[agents.shape[agent]];
  return std::abs(discs[0].x) + std::abs(discs[0].y) + discs[0].radius;
}

bool any_hit(const CutLists& cuts, const Agents& agents, Pair pair) {
  const auto [a, b] = std::minmax(pair.first, pair.second);
  return any_hit(float_placement(agents, pair), cuts.list(agents, a), cuts.list(agents, b));
}

}  // namespace bch::baselines
