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

/// Calls answer(query, agent) for agents begin .. end, for which the query was prepared, with a limit in metres.
template <class Query, class Answer>
void for_prepared(Query& query, std::size_t begin, std::size_t end, double limit, SearchMode mode,
                  const Answer& answer) {
  for (std::size_t first = begin; first < end; first += agents_together) {
    const auto from = static_cast<std::uint32_t>(first),
               to = static_cast<std::uint32_t>(std::min(first + agents_together, end));
    query.prepare(from, to, limit, mode);
    for (std::uint32_t agent = from; agent < to; ++agent) answer(query, agent);
  }
}

/// Calls answer(query, agent) for all agents, in tasks, each of which makes a query.
template <class MakeQuery, class Answer>
void for_agents(std::size_t agents, const MakeQuery& make, double limit, SearchMode mode,
                const Answer& answer) {
  for_ranges(agents, agents_per_task, [&](std::size_t begin, std::size_t end) {
    auto query = make();
    for_prepared(query, begin, end, limit, mode, answer);
  });
}

/// Validates the input of the query `name`. Returns: a function that makes a query; the input has to outlive it.
inline auto queries_of(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                       const Implementation* wanted, const char* name, Leaves leaves = Leaves::discs) {
  const bool exact = exact_leaves(shapes, leaves, name);
  const Implementation& implementation = chosen(wanted, name);
  validate(shapes, agents);
  return [&, exact] { return BodyQuery(implementation, shapes.view(), agents, obstacles.view(), exact); };
}
inline auto queries_of(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
                       const Implementation* wanted, const char* name) {
  const Implementation& implementation = chosen(wanted, name);
  require_valid_agents(bodies.view().ground, agents);
  return [&] { return SphereQuery(implementation, bodies.view(), agents, obstacles.view()); };
}

}  // namespace bch::detail
