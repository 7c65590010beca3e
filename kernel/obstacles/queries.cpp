// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <limits>

#include <bch/obstacles.hpp>

#include "kernel/distance/distance_input.hpp"
#include "kernel/obstacles/gap_query.hpp"
#include "kernel/obstacles/query_input.hpp"

namespace bch {

using namespace detail;

void collide(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const CollideOptions& options) {
  const FloatingPointStateGuard floats;
  check_size({"collide", "agent", agents.size()}, hits.size(), "hits");
  const bool exact = exact_leaves(shapes, options.leaves, "collide");
  const Implementation& implementation = chosen(options.implementation, "collide");
  validate(shapes, agents);
  for_agents(implementation, shapes, agents, obstacles, 0, Look::touching,
             [&](BodyQuery& query, std::uint32_t agent) {
               bool hit = false;
               if (const PlacedBody* const body = query.body(agent))
                 query.visit_hits(*body, exact, [&](std::uint32_t) { return hit = true, false; });
               hits[agent] = hit;
             });
}

void within(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers, Leaves leaves,
            const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const QueryName asked{"within", "agent", agents.size()};
  check_size(asked, answers.size(), "answers");
  require_distances(asked, distances);
  const bool exact = exact_leaves(shapes, leaves, "within");
  const Implementation& implementation = chosen(wanted, "within");
  validate(shapes, agents);
  const GapQuery query(implementation, shapes.view(), exact);
  const double most = distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
  for_agents(implementation, shapes, agents, obstacles, most, Look::nearest,
             [&](BodyQuery& body, std::uint32_t agent) {
               const double distance = distances[distances.size() == 1 ? 0 : agent];
               const NearestObstacle nearest = query.find(body, agent, distance, distance, true);
               answers[agent] = nearest.is_near_enough;
             });
}

void clearance(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
               const ClearanceAnswers& answers, const ClearanceOptions& options) {
  const FloatingPointStateGuard floats;
  require_valid({"clearance", "agent", agents.size()}, answers, options);
  const Implementation& implementation = chosen(options.implementation, "clearance");
  validate(shapes, agents);
  const bool zero = options.overlap == Overlap::zero;
  const bool exact = exact_leaves(shapes, options.leaves, "clearance");
  const double enough = zero ? 0 : -std::numeric_limits<double>::infinity();
  // How deep discs overlap is asked of discs.
  const GapQuery query(implementation, shapes.view(), exact && zero);
  for_agents(implementation, shapes, agents, obstacles, options.max_distance, Look::nearest,
             [&](BodyQuery& body, std::uint32_t agent) {
               const NearestObstacle nearest = query.find(body, agent, options.max_distance, enough, zero);
               if (nearest.is_near_enough) return store_alone(answers, agent, 0);
               if (!nearest.is_found)
                 return store_alone(answers, agent, std::numeric_limits<float>::infinity());
               store(shapes.view(), answers, agent, nearest);
             });
}

}  // namespace bch
