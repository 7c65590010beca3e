// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>

#include <bch/obstacles.hpp>

#include "kernel/body/agent_sphere.hpp"
#include "kernel/distance/distance_input.hpp"
#include "kernel/obstacles/query_input.hpp"

namespace bch {

using namespace detail;

namespace {

/// Holds the sphere of an agent and the point of an obstacle that are nearest to each other, relative to the agent's position.
class FoundObstacle {
 public:
  FoundObstacle(const BodySetView& bodies, const Agents& agents, std::uint32_t agent,
                const ObstacleView& obstacles, const SphereGap& nearest)
      : sphere_(bodies, agents, agent, nearest.slot), at_(sphere_.centre) {
    if (!nearest.is_inside) {
      const Sphere own = sphere_of(bodies.record(agents.shape[agent]), nearest.slot);
      const auto [x, y] = to_nearest_point(nearest.segment, double{own.x}, double{own.y});
      const auto [c, s] = rotation(agents.heading[agent]);
      at_.x += c * x - s * y, at_.y += s * x + c * y;
    }
    if (obstacles.heights != nullptr) {
      const double ground = agents.z.empty() ? 0 : agents.z[agent];
      const auto [bottom, top] = obstacles.heights[nearest.obstacle];
      at_.z = std::clamp(at_.z, bottom - ground, top - ground);
    }
    unit_ = unit_of(at_ - sphere_.centre);
  }

  Vec3 direction() const { return rounded(unit_); }
  BodyClearanceAnswers::Points points() const { return {sphere_.end(unit_, 1), rounded(at_)}; }

 private:
  const AgentSphere sphere_;
  SpacePoint at_, unit_;
};

void store(const BodySetView& bodies, const Agents& agents, std::uint32_t agent,
           const ObstacleView& obstacles, const SphereGap& nearest, const BodyClearanceAnswers& answers) {
  answers.distance[agent] = rounding::round_down(nearest.gap);
  if (answers.direction.empty() && answers.spheres.empty() && answers.points.empty()) return;
  const FoundObstacle found(bodies, agents, agent, obstacles, nearest);
  if (!answers.direction.empty()) answers.direction[agent] = found.direction();
  if (!answers.spheres.empty())
    answers.spheres[agent] = {bodies.number(agents.shape[agent], nearest.slot),
                              nearest.is_inside ? DiscPair::none.second : nearest.segment.number};
  if (!answers.points.empty()) answers.points[agent] = found.points();
}

}  // namespace

void collide(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  check_size({"collide", "agent", agents.size()}, hits.size(), "hits");
  const Implementation& implementation = chosen(wanted, "collide");
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
  const QueryName asked{"within", "agent", agents.size()};
  check_size(asked, answers.size(), "answers");
  require_distances(asked, distances);
  const Implementation& implementation = chosen(wanted, "within");
  require_valid_agents(bodies.view().ground, agents);
  const double most = distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
  for_agents(implementation, bodies.view(), agents, obstacles, most, Look::nearest,
             [&](SphereQuery& query, std::uint32_t agent) {
               answers[agent] = query.find(agent, distances[distances.size() == 1 ? 0 : agent]).is_found;
             });
}

void clearance(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
               const BodyClearanceAnswers& answers, const BodyClearanceOptions& options) {
  const FloatingPointStateGuard floats;
  require_valid({"clearance", "agent", agents.size()}, answers, options);
  const Implementation& implementation = chosen(options.implementation, "clearance");
  const BodySetView& view = bodies.view();
  require_valid_agents(view.ground, agents);
  const bool zero = options.overlap == Overlap::zero;
  for_agents(implementation, view, agents, obstacles, options.max_distance, Look::nearest,
             [&](SphereQuery& query, std::uint32_t agent) {
               const SphereGap nearest = query.find(agent, options.max_distance);
               if (!nearest.is_found)
                 return store_alone(answers, agent, std::numeric_limits<float>::infinity());
               if (zero && nearest.gap <= 0) return store_alone(answers, agent, 0);
               store(view, agents, agent, obstacles.view(), nearest, answers);
             });
}

}  // namespace bch
