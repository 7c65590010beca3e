// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>

#include <bch/obstacles.hpp>

#include "kernel/body/agent_sphere.hpp"
#include "kernel/distance/distance_input.hpp"
#include "kernel/distance/nearest_features.hpp"
#include "kernel/obstacles/query_input.hpp"
#include "layout/format/cut_discs.hpp"

namespace bch {

using namespace detail;

namespace {

using Vector = ObstaclePlace::Vector;
constexpr double infinite_gap = std::numeric_limits<double>::infinity();

double square(Vector v) noexcept {
  return v.x * v.x + v.y * v.y;
}

/// What is nearest to an obstacle's segment, a disc's centre or a point of an outline, and the vector from there, in the agent's frame.
struct Nearest {
  Vector from, offset;
  double radius;  ///< of the disc
};

Nearest of_disc(const CutDiscs& discs, std::uint32_t disc, const LocalSegment& segment) noexcept {
  const double x = discs.x[disc], y = discs.y[disc];
  return {{x, y}, to_nearest_point(segment, x, y), discs.radius[disc]};
}

/// Returns the nearest points of an outline's segment and an obstacle's that do not cross: an end of one, and what is nearest to it.
Nearest of_outline(const Vec2* ends, const LocalSegment& segment) noexcept {
  const double x = ends[0].x, y = ends[0].y, edge_x = double{ends[1].x} - x, edge_y = double{ends[1].y} - y;
  const double length = square({edge_x, edge_y});
  Nearest nearest{{x, y}, to_nearest_point(segment, x, y), 0};
  const auto take = [&](double t) {
    const Vector at{x + t * edge_x, y + t * edge_y}, to = to_nearest_point(segment, at.x, at.y);
    if (square(to) < square(nearest.offset)) nearest = {at, to, 0};
  };
  take(1);
  for (const double end : {segment.from, segment.to}) {
    const double to_x = end * segment.x - segment.offset * segment.y - x,
                 to_y = end * segment.y + segment.offset * segment.x - y;
    if (length > 0) take(std::clamp((to_x * edge_x + to_y * edge_y) / length, 0.0, 1.0));
  }
  return nearest;
}

Vec2 to_float(Vector v) noexcept {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

/// Writes what is asked for of an agent's nearest obstacle.
void put(const ClearanceAnswers& answers, std::size_t i, const NearestObstacle& nearest) {
  answers.distance[i] = rounding::round_down(nearest.gap);
  if (answers.direction.empty() && answers.discs.empty() && answers.points.empty()) return;
  const bool is_disc = nearest.point == no_point;
  const ShapeSetView& shapes = nearest.body->shapes;
  const std::uint32_t root = nearest.body->root_index();
  const auto [at, offset, radius] = is_disc ? of_disc(cut_discs(shapes, root), nearest.disc, nearest.segment)
                                            : of_outline(shapes.points + nearest.point, nearest.segment);
  const double length = std::sqrt(square(offset));
  const Vector turned = nearest.body->place.turned(offset.x, offset.y),
               from = nearest.body->place.turned(at.x, at.y);
  const Vector unit = length > 0 ? Vector{turned.x / length, turned.y / length} : Vector{1, 0};
  if (!answers.direction.empty()) answers.direction[i] = to_float(unit);
  if (!answers.discs.empty()) {
    const std::uint32_t disc =
        is_disc ? nearest.disc : leaf_containing(shapes, root, nearest.point, at.x, at.y);
    answers.discs[i] = {disc, nearest.segment.number};
  }
  if (!answers.points.empty())
    answers.points[i] = {to_float({from.x + radius * unit.x, from.y + radius * unit.y}),
                         to_float({from.x + turned.x, from.y + turned.y})};
}

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

void put(const BodySetView& bodies, const Agents& agents, std::uint32_t agent, const ObstacleView& obstacles,
         const SphereGap& nearest, const BodyClearanceAnswers& answers) {
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

void clearance(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
               const ClearanceAnswers& answers, const ClearanceOptions& options) {
  const FloatingPointStateGuard floats;
  require_valid({"clearance", "agent", agents.size()}, answers, options);
  const bool zero = options.overlap == Overlap::zero;
  // How deep discs overlap is measured from discs.
  const bool exact = exact_leaves(shapes, options.leaves, "clearance") && zero;
  const auto make = queries_of(shapes, agents, obstacles, options.implementation, "clearance",
                               exact ? Leaves::segments : Leaves::discs);
  for_agents(agents.size(), make, options.max_distance, SearchMode::nearest,
             [&](BodyQuery& query, std::uint32_t agent) {
               const NearestObstacle nearest =
                   query.nearest(agent, options.max_distance, zero ? 0 : -infinite_gap, zero);
               if (nearest.is_within) return store_distance(answers, agent, 0);
               if (!nearest.is_found) return store_distance(answers, agent, static_cast<float>(infinite_gap));
               put(answers, agent, nearest);
             });
}

void clearance(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
               const BodyClearanceAnswers& answers, const BodyClearanceOptions& options) {
  const FloatingPointStateGuard floats;
  require_valid({"clearance", "agent", agents.size()}, answers, options);
  const bool zero = options.overlap == Overlap::zero;
  const auto make = queries_of(bodies, agents, obstacles, options.implementation, "clearance");
  for_agents(agents.size(), make, options.max_distance, SearchMode::nearest,
             [&](SphereQuery& query, std::uint32_t agent) {
               const SphereGap nearest = query.nearest(agent, options.max_distance);
               if (!nearest.is_found) return store_distance(answers, agent, static_cast<float>(infinite_gap));
               if (zero && nearest.gap <= 0) return store_distance(answers, agent, 0);
               put(bodies.view(), agents, agent, obstacles.view(), nearest, answers);
             });
}

}  // namespace bch
