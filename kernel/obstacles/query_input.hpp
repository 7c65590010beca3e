// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>

#include <bch/obstacles.hpp>

#include "kernel/obstacles/sphere_query.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch::detail {

constexpr std::size_t agents_per_task = 256;

/// The number of agents that are prepared together: enough to hide the latency of the tree of boxes, few enough for
/// a near cache.
constexpr std::size_t agents_together = 64;

/// Calls answer(agent) for agents begin .. end, for which a body's query is prepared; those who were left out have no obstacle within a limit, metres.
template <class Answer>
void for_prepared(BodyQuery& body, std::size_t begin, std::size_t end, double limit, Look look,
                  Answer answer) {
  for (std::size_t first = begin; first < end; first += agents_together) {
    const auto from = static_cast<std::uint32_t>(first),
               to = static_cast<std::uint32_t>(std::min(first + agents_together, end));
    body.prepare(from, to, limit, look);
    for (std::uint32_t agent = from; agent < to; ++agent) answer(agent);
  }
}

/// Calls answer(body, agent) for all agents, in tasks.
template <class Answer>
void for_agents(const Implementation& implementation, const ShapeSet& shapes, const Agents& agents,
                const ObstacleSet& obstacles, double limit, Look look, Answer answer) {
  for_ranges(agents.size(), agents_per_task, [&](std::size_t begin, std::size_t end) {
    BodyQuery body(implementation, shapes.view(), agents, obstacles.view());
    for_prepared(body, begin, end, limit, look, [&](std::uint32_t agent) { answer(body, agent); });
  });
}

/// Calls answer(spheres, agent) for all agents of bodies of spheres, in tasks.
template <class Answer>
void for_agents(const Implementation& implementation, const BodySetView& bodies, const Agents& agents,
                const ObstacleSet& obstacles, double limit, Look look, Answer answer) {
  for_ranges(agents.size(), agents_per_task, [&](std::size_t begin, std::size_t end) {
    BodyQuery body(implementation, bodies.ground, agents, obstacles.view(), true);
    SphereQuery spheres(bodies, body, agents);
    for_prepared(body, begin, end, limit, look, [&](std::uint32_t agent) { answer(spheres, agent); });
  });
}

}  // namespace bch::detail
