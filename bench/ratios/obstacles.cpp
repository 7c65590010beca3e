// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <bch/obstacles.hpp>

#include "baselines/obstacle_reference.hpp"
#include "bench/ratios/ratios.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

constexpr std::uint64_t plan_seed = 35;
constexpr double wall_density = 1;                  ///< agents, and segments, per square metre
constexpr double room = 6, door = 1, pillar = 0.2;  ///< metres
constexpr std::uint32_t corners = 8;                ///< of a pillar
constexpr std::uint32_t checked_agents = 100;       ///< by brute force over everything
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Walls and pillars for the queries against obstacles, and the same for brute force.
struct FloorPlan {
  std::vector<double> x, y;
  std::vector<std::uint64_t> polyline_offsets{0};
  std::vector<std::uint8_t> is_area;
  std::vector<baselines::ReferenceObstacle> reference;

  void add(const std::vector<double>& of_x, const std::vector<double>& of_y, bool area) {
    x.insert(x.end(), of_x.begin(), of_x.end());
    y.insert(y.end(), of_y.begin(), of_y.end());
    polyline_offsets.push_back(x.size());
    is_area.push_back(area);
    reference.push_back({{}, area});
    for (std::size_t i = 1; i < of_x.size() + area; ++i)
      reference.back().segments.push_back(
          {of_x[i - 1], of_y[i - 1], of_x[i % of_x.size()], of_y[i % of_x.size()]});
  }

  /// Adds a side of a room, with a door: two lines of so many pieces each.
  void add_wall(double from_x, double from_y, bool upright, double length, std::uint32_t pieces) {
    for (const double begin : {0.0, (length + door) / 2}) {
      std::vector<double> along, across;
      for (std::uint32_t i = 0; i <= pieces; ++i) {
        along.push_back((upright ? from_y : from_x) + begin + (length - door) / 2 * i / pieces);
        across.push_back(upright ? from_x : from_y);
      }
      upright ? add(across, along, false) : add(along, across, false);
    }
  }
};

/// Draws rooms with a side of 6 m or so and doors of 1 m, and octagonal pillars, in a square: so many segments in
/// all, two fifths of them of pillars. Walls are lines in pieces of one length, as scans and outlines of curved
/// walls are.
FloorPlan floor_plan(std::uint32_t segments, double side) {
  FloorPlan plan;
  detail::Random random(plan_seed);
  const std::uint32_t pillars = segments * 2 / 5 / corners;
  const auto rooms = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::lround(side / room)));
  const double length = side / rooms;
  const std::uint32_t pieces =
      std::max<std::uint32_t>(1, (segments - pillars * corners) / (4 * rooms * rooms));
  for (std::uint32_t i = 0; i < rooms; ++i)
    for (std::uint32_t j = 0; j < rooms; ++j)
      for (const bool upright : {false, true}) plan.add_wall(i * length, j * length, upright, length, pieces);
  for (std::uint32_t i = 0; i < pillars; ++i) {
    const double x = random.uniform(side), y = random.uniform(side);
    std::vector<double> px, py;
    for (std::uint32_t k = 0; k < corners; ++k) {
      px.push_back(x + pillar * std::cos(2 * std::numbers::pi * k / corners));
      py.push_back(y + pillar * std::sin(2 * std::numbers::pi * k / corners));
    }
    plan.add(px, py, true);
  }
  return plan;
}

/// A crowd on a floor plan with as many segments as agents.
struct Floor {
  Scene& scene;
  cli::Crowd crowd = cli::place_crowd(scene.agents(), wall_density, scene.set().shape_count(), crowd_seed);
  Agents agents = crowd.agents();
  FloorPlan plan = floor_plan(scene.agents(), crowd.side);
  ObstacleSet obstacles{{plan.x, plan.y, plan.polyline_offsets, {}, plan.is_area}};
  baselines::ObstacleReference reference{scene.shapes(), {}, Leaves::segments};

  explicit Floor(Scene& in) : scene(in) {}

  std::uint32_t checked() const { return std::min(checked_agents, static_cast<std::uint32_t>(crowd.size())); }
  bool collides(std::uint32_t agent) const {
    return std::ranges::any_of(
        plan.reference, [&](const auto& obstacle) { return reference.collides(agents, agent, obstacle); });
  }
  /// Returns whether a distance of an agent is what brute force says.
  bool is_right(std::uint32_t agent, double limit, Leaves leaves, float distance) const {
    const bool exact = leaves == Leaves::segments;
    double expected = (exact ? reference.outline_gap(agents, agent, plan.reference)
                             : reference.gap(agents, agent, plan.reference))
                          .gap;
    for (const auto& obstacle : plan.reference)
      if (reference.outline_contains(agents, agent, obstacle) ||
          (exact ? reference.contains_the_outline(agents, agent, obstacle)
                 : reference.contains_a_centre(agents, agent, obstacle)))
        expected = 0;
    expected = std::max(expected, 0.0);
    return expected > limit ? std::isinf(distance)
                            : std::abs(static_cast<double>(distance) - expected) <= 1e-6 * (1 + expected);
  }
};

void require(bool right, std::uint32_t agent) {
  if (!right) throw std::runtime_error(fmt::format("obstacles: wrong answer for agent {}", agent));
}

Contender by_collide(const Floor& floor) {
  const auto hits = std::make_shared<Hits>(floor.crowd.size());
  const auto call = [&floor, hits] { collide(floor.scene.set(), floor.agents, floor.obstacles, *hits); };
  call();
  for (std::uint32_t i = 0; i < floor.checked(); ++i) require((*hits)[i] == floor.collides(i), i);
  const auto count = static_cast<double>(std::ranges::count(*hits, 1));
  return {call, hits->size(), {{"percent", 100 * count / static_cast<double>(hits->size())}}};
}

Contender by_clearance(const Floor& floor, double limit, Leaves leaves = Leaves::discs) {
  const auto distance = std::make_shared<std::vector<float>>(floor.crowd.size());
  const auto direction = std::make_shared<std::vector<Vec2>>(floor.crowd.size());
  const auto call = [&floor, distance, direction, limit, leaves] {
    clearance(floor.scene.set(), floor.agents, floor.obstacles, {*distance, *direction},
              {.max_distance = limit, .leaves = leaves});
  };
  call();
  for (std::uint32_t i = 0; i < floor.checked(); ++i)
    require(floor.is_right(i, limit, leaves, (*distance)[i]), i);
  return {call, distance->size()};
}

/// A plain loop: each segment against the circle about an agent, and what is left in all detail.
Contender by_loop(const Floor& floor) {
  const auto call = [&floor] {
    const Agents& agents = floor.agents;
    for (std::uint32_t i = 0; i < floor.checked(); ++i) {
      const double radius = floor.scene.set().bounding_radius(agents.shape[i]);
      bool hit = false;
      for (const auto& obstacle : floor.plan.reference) {
        const bool is_near = std::ranges::any_of(obstacle.segments, [&](const auto& ends) {
          const double x = ends[2] - ends[0], y = ends[3] - ends[1];
          const double px = agents.x[i] - ends[0], py = agents.y[i] - ends[1];
          const double t = std::clamp((px * x + py * y) / (x * x + y * y), 0.0, 1.0);
          const double dx = px - t * x, dy = py - t * y;
          return dx * dx + dy * dy <= radius * radius;
        });
        hit = hit || (is_near && floor.reference.collides(agents, i, obstacle));
      }
      benchmark::DoNotOptimize(hit);
    }
  };
  return {call, floor.checked()};
}

}  // namespace

void add_obstacles(Scene& scene) {
  const auto floor = once([&scene] { return std::make_shared<const Floor>(scene); });
  add("obstacles/collide", [floor] { return by_collide(floor()); });
  add("obstacles/clearance", [floor] { return by_clearance(floor(), clearance_limit); });
  add("obstacles/clearance_exact",
      [floor] { return by_clearance(floor(), clearance_limit, Leaves::segments); });
  add("obstacles/clearance_unlimited", [floor] { return by_clearance(floor(), infinity); });
  add("obstacles/loop", [floor] { return by_loop(floor()); });
}

}  // namespace bch::bench
