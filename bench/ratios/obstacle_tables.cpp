// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include <bch/obstacles.hpp>

#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/distance_answers.hpp"
#include "bench/workload/floor_plan.hpp"

namespace bch::bench {
namespace {

constexpr std::uint64_t plan_seed = 35;
constexpr double wall_density = 1;  ///< agents, and segments, per square metre
constexpr double most_collide = 60, most_clearance = 200, needed_over_brute_force = 500;
constexpr std::uint32_t checked_agents = 100;  ///< by brute force over everything
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A crowd on a floor plan with as many segments as agents.
struct Floor {
  Scene& scene;
  cli::Crowd crowd;
  FloorPlan plan;
  ObstacleSet obstacles;
  baselines::ObstacleReference reference;

  explicit Floor(Scene& in)
      : scene(in),
        crowd(cli::place_crowd(in.agents(), wall_density, in.set().shape_count(), crowd_seed)),
        plan(floor_plan(in.agents(), crowd.side, plan_seed)),
        obstacles(plan.set()),
        reference(in.shapes(), {}, Leaves::segments) {}

  std::uint32_t checked() const { return std::min(checked_agents, static_cast<std::uint32_t>(crowd.size())); }
  bool collides(std::uint32_t agent) const {
    return std::any_of(plan.reference.begin(), plan.reference.end(), [&](const auto& obstacle) {
      return reference.collides(crowd.agents(), agent, obstacle);
    });
  }
  /// Returns whether a distance of an agent is what brute force says.
  bool is_right(std::uint32_t agent, double limit, Leaves leaves, float distance) const {
    const bool exact = leaves == Leaves::segments;
    double expected = (exact ? reference.outline_gap(crowd.agents(), agent, plan.reference)
                             : reference.gap(crowd.agents(), agent, plan.reference))
                          .gap;
    for (const auto& obstacle : plan.reference)
      if (exact ? reference.holds_the_outline(crowd.agents(), agent, obstacle)
                : reference.holds_a_centre(crowd.agents(), agent, obstacle))
        expected = 0;
    expected = expected > limit ? infinity : std::max(expected, 0.0);
    return expected == infinity ? std::isinf(distance)
                                : std::abs(static_cast<double>(distance) - expected) <= 1e-6 * (1 + expected);
  }
  void require(bool right, std::uint32_t agent) const {
    if (!right) throw std::runtime_error(fmt::format("obstacles: wrong answer for agent {}", agent));
  }
};

Contender collide_contender(const std::shared_ptr<Floor>& floor) {
  const auto hits = std::make_shared<Hits>(floor->crowd.size());
  const auto call = [floor, hits] {
    collide(floor->scene.set(), floor->crowd.agents(), floor->obstacles, *hits);
  };
  call();
  for (std::uint32_t i = 0; i < floor->checked(); ++i) floor->require((*hits)[i] == floor->collides(i), i);
  const auto count = static_cast<double>(std::count(hits->begin(), hits->end(), 1));
  return {call, hits->size(), {{"hits", count / static_cast<double>(hits->size())}}};
}

Contender clearance_contender(const std::shared_ptr<Floor>& floor, double limit,
                              Leaves leaves = Leaves::discs) {
  const auto answers = std::make_shared<Clearances>(floor->crowd.size());
  const auto call = [floor, answers, limit, leaves] {
    clearance(floor->scene.set(), floor->crowd.agents(), floor->obstacles, answers->spans(),
              {.max_distance = limit, .distance_leaves = leaves});
  };
  call();
  for (std::uint32_t i = 0; i < floor->checked(); ++i)
    floor->require(floor->is_right(i, limit, leaves, answers->distance[i]), i);
  return {call, answers->distance.size()};
}

/// A plain loop: each segment against the circle about an agent, and what is left in all detail.
Contender loop_contender(const std::shared_ptr<Floor>& floor) {
  const auto call = [floor] {
    const Agents agents = floor->crowd.agents();
    for (std::uint32_t i = 0; i < floor->checked(); ++i) {
      const double radius = floor->scene.set().bounding_radius(agents.shape[i]);
      bool hit = false;
      for (const auto& obstacle : floor->plan.reference) {
        const bool is_near =
            std::any_of(obstacle.segments.begin(), obstacle.segments.end(), [&](const auto& ends) {
              const double x = ends[2] - ends[0], y = ends[3] - ends[1];
              const double px = agents.x[i] - ends[0], py = agents.y[i] - ends[1];
              const double share = std::clamp((px * x + py * y) / (x * x + y * y), 0.0, 1.0);
              const double dx = px - share * x, dy = py - share * y;
              return dx * dx + dy * dy <= radius * radius;
            });
        hit = hit || (is_near && floor->reference.collides(agents, i, obstacle));
      }
      // Kept, so that the loop is not left out.
      [[maybe_unused]] static volatile bool last;
      last = hit;
    }
  };
  return {call, floor->checked()};
}

void print_obstacles(const Results& results) {
  const Timing& own = results.at("obstacles/collide");
  fmt::print("{} agents on a floor of as many segments, one thread; {:.0f} % collide\n",
             cli::grouped(own.items), 100 * own.counters.at("hits"));
  const auto print = [&](std::string_view title, const Timing& timing, double most) {
    fmt::print("  {:28}{:8.1f} ns an agent   {}\n", title, timing.nanoseconds,
               most > 0 ? verdict_at_most(timing.nanoseconds, most) : "");
  };
  print("collide", own, most_collide);
  print("clearance within 0.5 m", results.at("obstacles/clearance"), most_clearance);
  print("the same of outlines", results.at("obstacles/clearance_exact"), 0);
  print("clearance without a limit", results.at("obstacles/clearance_unlimited"), most_clearance);
  const double loop = results.at("obstacles/loop").nanoseconds;
  fmt::print("  {:28}{:8.0f} ns an agent, {:.0f} x collide's   {}\n", "a loop over all segments", loop,
             loop / own.nanoseconds, verdict(loop / own.nanoseconds, needed_over_brute_force));
}

}  // namespace

std::vector<Table> obstacle_tables(Suite& suite, Scene& scene) {
  const Shared<Floor> floor([&scene] { return std::make_shared<Floor>(scene); });
  suite.add("obstacles/collide", [floor] { return collide_contender(floor.get()); });
  suite.add("obstacles/clearance", [floor] { return clearance_contender(floor.get(), clearance_limit); });
  suite.add("obstacles/clearance_exact",
            [floor] { return clearance_contender(floor.get(), clearance_limit, Leaves::segments); });
  suite.add("obstacles/clearance_unlimited", [floor] { return clearance_contender(floor.get(), infinity); });
  suite.add("obstacles/loop", [floor] { return loop_contender(floor.get()); });
  return {{"obstacles", "^obstacles/", print_obstacles}};
}

}  // namespace bch::bench
