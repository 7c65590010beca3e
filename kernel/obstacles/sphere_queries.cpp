// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include <bch/obstacles.hpp>

#include "kernel/distance/distance_input.hpp"
#include "kernel/obstacles/query_input.hpp"

namespace bch {

using namespace detail;

void collide(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  require_as_many({"collide", "agent", agents.size()}, hits.size(), "hits");
  const Implementation& implementation = chosen({.implementation = wanted}, "collide");
  require_valid_agents(bodies.view().ground, agents);
  for_agents(implementation, bodies.view(), agents, obstacles, 0, Look::touching,
             [&](SphereQuery& query, std::uint32_t agent) {
               bool hit = false;
               query.visit_hits(agent, [&](std::uint32_t) { return hit = true, false; });
               hits[agent] = hit;
             });
}

void within(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const Asked asked{"within", "agent", agents.size()};
  require_as_many(asked, answers.size(), "answers");
  require_distances(asked, distances);
  const Implementation& implementation = chosen({.implementation = wanted}, "within");
  require_valid_agents(bodies.view().ground, agents);
  const double most = distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
  for_agents(implementation, bodies.view(), agents, obstacles, most, Look::nearest,
             [&](SphereQuery& query, std::uint32_t agent) {
               answers[agent] = query.find(agent, distances[distances.size() == 1 ? 0 : agent]).is_found;
             });
}

}  // namespace bch
