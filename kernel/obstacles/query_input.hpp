// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>

#include <bch/obstacles.hpp>

#include "kernel/obstacles/body_query.hpp"
#include "kernel/runtime/floating_point_state.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch::detail {

constexpr std::size_t agents_per_task = 256;

/// Requires as many values as agents, or throws std::invalid_argument naming the query.
void require_an_answer_each(const char* query, const Agents& agents, std::size_t size, const char* what);

/// Returns what collide() means with these options. Errors: throws std::invalid_argument as collide().
BodyQuery::Meaning meaning_of(const ShapeSet& shapes, const QueryOptions& options);

/// Answers agents one after the other: calls answer(body, agent) for each, with a BodyQuery that tasks of agents share.
template <class Answer>
void for_agents(const Implementation& implementation, const ShapeSet& shapes, const Agents& agents,
                const ObstacleSet& obstacles, Answer answer) {
  for_ranges(agents.size(), agents_per_task, [&](std::size_t begin, std::size_t end) {
    BodyQuery body(implementation, shapes.view(), agents, obstacles.view());
    for (std::size_t i = begin; i < end; ++i) answer(body, static_cast<std::uint32_t>(i));
  });
}

}  // namespace bch::detail
