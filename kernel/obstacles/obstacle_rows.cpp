// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/obstacle_rows.hpp"

#include <algorithm>

#include "kernel/obstacles/query_input.hpp"

namespace bch::detail {

/// Collects what visit(query, agent, found) finds of each agent, in tasks that have a query each.
template <class MakeQuery, class Visit>
Rows<std::uint32_t> ObstacleRows::find_all(std::size_t agents, const MakeQuery& make_query,
                                           const Visit& visit) {
  const std::size_t count = (agents + agents_per_task - 1) / agents_per_task;
  if (blocks_.size() < count) blocks_.resize(count);
  offsets_.assign(agents + 1, 0);
  for_ranges(count, 1, [&](std::size_t first, std::size_t last) {
    BodyQuery query = make_query();
    for (std::size_t block = first; block < last; ++block) {
      std::vector<std::uint32_t>& found = blocks_[block];
      found.clear();
      const std::size_t end = std::min((block + 1) * agents_per_task, agents);
      for_prepared(query, block * agents_per_task, end, 0, Look::touching, [&](std::uint32_t agent) {
        const auto begin = static_cast<std::ptrdiff_t>(found.size());
        visit(query, agent, [&](std::uint32_t obstacle) { return found.push_back(obstacle), true; });
        std::sort(found.begin() + begin, found.end());
        offsets_[agent + std::size_t{1}] = found.size() - static_cast<std::size_t>(begin);
      });
    }
  });
  for (std::size_t i = 0; i < agents; ++i) offsets_[i + 1] += offsets_[i];
  values_.clear();
  for (std::size_t block = 0; block < count; ++block)
    values_.insert(values_.end(), blocks_[block].begin(), blocks_[block].end());
  return {offsets_, values_};
}

Rows<std::uint32_t> ObstacleRows::find(const ShapeSet& shapes, const Agents& agents,
                                       const ObstacleSet& obstacles, const CollideOptions& options) {
  const FloatingPointStateGuard floats;
  const bool exact = exact_leaves(shapes, options.leaves, "collide");
  const Implementation& implementation = chosen(options.implementation, "collide");
  validate(shapes, agents);
  return find_all(
      agents.size(), [&] { return BodyQuery(implementation, shapes.view(), agents, obstacles.view()); },
      [&](BodyQuery& query, std::uint32_t agent, const auto& found) {
        if (const PlacedBody* const body = query.body(agent)) query.visit_hits(*body, exact, found);
      });
}

Rows<std::uint32_t> ObstacleRows::find(const BodySet& bodies, const Agents& agents,
                                       const ObstacleSet& obstacles, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const Implementation& implementation = chosen(wanted, "collide");
  const BodySetView& view = bodies.view();
  require_valid_agents(view.ground, agents);
  return find_all(
      agents.size(), [&] { return BodyQuery(implementation, view.ground, agents, obstacles.view(), true); },
      [&](BodyQuery& query, std::uint32_t agent, const auto& found) {
        SphereQuery(view, query, agents).visit_hits(agent, found);
      });
}

}  // namespace bch::detail
