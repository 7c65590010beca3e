// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/reference.hpp"

#include <algorithm>

#include "baselines/disc_tree.hpp"
#include "baselines/oracle.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

namespace bch::baselines {

Reference::Reference(std::span<const Shape> shapes, const ShapeSetPlan& plan, Leaves leaves)
    : shapes_(shapes),
      depths_(plan.depths),
      has_outlines_(plan.outlines),
      cuts_(shapes, plan),
      segments_(shapes, plan, leaves) {
  for (const Shape& shape : shapes) heights_.push_back(detail::height(shape.hierarchy));
}

bool Reference::compare_all(const Agents& agents, Pair pair) const {
  if (!segments_.decide(agents, pair)) return any_hit(cuts_, agents, pair);
  const FloatPlacement place = float_placement(agents, pair);
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const CutList &a = cuts_.list(agents, first), &b = cuts_.list(agents, second);
  for (std::size_t i = 0; i < a.discs.size(); ++i)
    for (std::size_t j = 0; j < b.discs.size(); ++j)
      if (all_overlap(place, a.path(i), b.path(j)) &&
          segments_.meet(place, agents, pair, a.nodes[i], b.nodes[j]))
        return true;
  return false;
}

bool Reference::descend(const Agents& agents, Pair pair) const {
  const FloatPlacement place = float_placement(agents, pair);
  const auto tree = [&](std::uint32_t agent) {
    const std::uint32_t shape = agents.shape[agent];
    const std::size_t level = agents.root(agent, depths_.size()) % depths_.size();
    return DiscTree{shapes_[shape].hierarchy.nodes.data(), depths_[level], heights_[shape]};
  };
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const DiscTree a = tree(first), b = tree(second);
  const bool exact = segments_.decide(agents, pair);
  return any_ends_overlap(place, a, b, NoCounts{}, [&](const NodePair& at) {
    return (!exact || segments_.meet(place, agents, pair, at.a, at.b)) &&
           is_verified(place, a, b, at, NoCounts{});
  });
}

bool Reference::boundary(const Agents& agents, Pair pair, Method method) const {
  return method == Method::brute_force ? compare_all(agents, pair) : descend(agents, pair);
}

bool Reference::solid(const Agents& agents, Pair pair, Method method) const {
  if (boundary(agents, pair, method)) return true;
  if (!has_outlines_) return false;
  const auto [a, b] = pair;
  return Oracle(shapes_[agents.shape[a]].outline, shapes_[agents.shape[b]].outline,
                exact_placement(agents, a, b))
      .nested();
}

}  // namespace bch::baselines
