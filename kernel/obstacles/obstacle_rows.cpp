// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/obstacle_rows.hpp"

#include <algorithm>

#include "kernel/obstacles/query_input.hpp"

namespace bch::detail {

/// Collects what visit(query, agent, found) finds of each agent.
template <class MakeQuery, class Visit>
Rows<std::uint32_t> ObstacleRows::find_all(std::size_t agents, const MakeQuery& make_query,
                                           const Visit& visit) {
  return rows_.collect(agents, agents_per_task, [&] {
    return [&visit, query = make_query()](std::size_t begin, std::size_t end, const auto& add) mutable {
      for_prepared(query, begin, end, 0, Look::touching, [&](std::uint32_t agent) {
        add(agent, [&](std::vector<std::uint32_t>& all) {
          const auto first = static_cast<std::ptrdiff_t>(all.size());
          visit(query, agent, [&](std::uint32_t obstacle) { return all.push_back(obstacle), true; });
          std::sort(all.begin() + first, all.end());
        });
      });
    };
  });
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
