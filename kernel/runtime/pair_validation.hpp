// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <span>

#include <bch/query.hpp>

#include "kernel/runtime/kernels.hpp"
#include "kernel/simd/arguments.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// The number of pairs per task of a query: enough to hide the cost of a task, few enough to balance four cores over a small
/// crowd.
constexpr std::size_t pairs_per_task = 2048;

/// Returns `wanted`, or best_implementation() for null.
/// Errors:  throws std::invalid_argument naming the query if this processor does not run it.
const Implementation& chosen(const Implementation* wanted, const char* query);

/// Names a query, what it answers for ("pair" or "agent"), and how many of these there are.
struct QueryName {
  const char* query;
  const char* one;
  std::size_t count;
};

/// check_size() requires as many values as answers; require_choice() requires that an option is 0 or 1.
/// Errors: both throw std::invalid_argument naming the query and what is wrong; `words` names the two options.
void check_size(const QueryName& context, std::size_t size, const char* what);
void require_choice(const char* query, const char* what, int value, const char* words);

/// Returns whether segments decide at some leaves: `leaves` selects them, and the set has them.
/// Errors:  throws std::invalid_argument naming the query on an unknown value.
bool exact_leaves(const ShapeSet& shapes, Leaves leaves, const char* query);

/// Returns the input of a kernel, which refers to all parameters. `pairs` may be empty.
Arguments arguments_for(const ShapeSetView& view, const Agents& agents, std::span<const Pair> pairs);

/// Requires that all agents are valid.
/// Errors:  throws std::invalid_argument on sizes that differ, and naming the first agent that AgentCheck does not pass, and the value.
void require_valid_agents(const ShapeSetView& shapes, const Agents& agents);

/// Requires that the agents that pairs name are valid; other agents need not be.
/// Errors:  throws std::invalid_argument on sizes that differ, and naming the first pair with an index out of
///          range or an agent that AgentCheck does not pass, and the value.
/// Threads: runs in the caller's TBB arena.
void require_valid(const Implementation& implementation, const ShapeSetView& shapes, const Agents& agents,
                   std::span<const Pair> pairs);

}  // namespace bch::detail
