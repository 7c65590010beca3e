// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/pair_validation.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <bch/query.hpp>

#include "kernel/runtime/agent_check.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "kernel/runtime/validation.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch::detail {
namespace {

/// From this number on (3 MB), agents are prefetched. With fewer, that costs 1 % (and 13 % for single cylinders).
constexpr std::size_t many_agents = 100'000;
/// From this number on (2 MB), shapes are prefetched. With 5 000 that saves a quarter of a query's time, with 200 it costs 2 to 6 %.
constexpr std::uint32_t many_shapes = 500;

template <class Value>
AgentColumn column_of(const Strided<Value>& values) noexcept {
  return {reinterpret_cast<const unsigned char*>(values.empty() ? nullptr : values.data()), values.stride(),
          false};
}
AgentColumn column_of(const Numbers& values) noexcept {
  return {static_cast<const unsigned char*>(values.empty() ? nullptr : values.data()), values.stride(),
          values.is_float()};
}

bool is_valid(const Arguments& arguments, std::size_t agent) noexcept {
  return AgentCheck<void>::passes(arguments, agent, agent + 1);
}

/// Returns the lowest index in [0, count) for which `bad` holds, or count. `all_good(begin, end)` quickly excludes ranges. The
/// floating-point state is as for for_ranges().
template <class AllGood, class Bad>
std::size_t first_bad(std::size_t count, AllGood all_good, Bad bad) {
  const auto search = [&](std::size_t begin, std::size_t end, std::size_t found) {
    if (begin >= found || all_good(begin, end)) return found;
    for (std::size_t i = begin; i < end && i < found; ++i)
      if (bad(i)) return i;
    return found;
  };
  return reduce_ranges(count, pairs_per_task, count, search,
                       [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

std::size_t first_bad_agent(const Implementation& implementation, const Arguments& arguments,
                            const Agents& agents) {
  return first_bad(
      agents.size(),
      [&](std::size_t begin, std::size_t end) {
        return implementation.kernels->check(arguments, begin, end);
      },
      [&](std::size_t i) { return !is_valid(arguments, i); });
}

[[noreturn]] void reject_pair(const Arguments& arguments, const Agents& agents, std::span<const Pair> pairs,
                              std::size_t i) {
  const std::string place = "pair " + std::to_string(i) + ": ";
  for (const std::uint32_t agent : {pairs[i].first, pairs[i].second}) {
    if (agent >= agents.size())
      throw std::invalid_argument(place + "expected one of " + std::to_string(agents.size()) +
                                  " agents, found " + std::to_string(agent));
    if (is_valid(arguments, agent)) continue;
    try {
      reject(*arguments.shapes, agents, agent);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(place + error.what());
    }
  }
  throw std::logic_error(place + "rejected without a reason");
}

}  // namespace

const Implementation& chosen(const Implementation* wanted, const char* query) {
  if (wanted == nullptr) return best_implementation();
  if (!wanted->supported())
    throw std::invalid_argument(std::string(query) +
                                ": expected an implementation that this processor runs, found '" +
                                wanted->name + "'");
  return *wanted;
}

void check_size(const QueryName& context, std::size_t size, const char* what) {
  if (size != context.count)
    throw std::invalid_argument(std::string(context.query) + ": expected " + std::to_string(context.count) +
                                " " + what + ", one per " + context.one + ", found " + std::to_string(size));
}

void require_choice(const char* query, const char* what, int value, const char* words) {
  if (value != 0 && value != 1)
    throw std::invalid_argument(std::string(query) + ": expected " + what + " of " + words + ", found " +
                                std::to_string(value));
}

bool exact_leaves(const ShapeSet& shapes, Leaves leaves, const char* query) {
  require_choice(query, "leaves", static_cast<int>(leaves), "0 (discs) or 1 (segments)");
  return leaves == Leaves::segments && shapes.exact_leaves();
}

Arguments arguments_for(const ShapeSetView& view, const Agents& agents, std::span<const Pair> pairs) {
  return {.shapes = &view,
          .agent_count = static_cast<std::uint32_t>(agents.size()),
          .agent_shape = column_of(agents.shape),
          .agent_x = column_of(agents.x),
          .agent_y = column_of(agents.y),
          .agent_heading = column_of(agents.heading.x()),
          .agent_heading_y = column_of(agents.heading.y()),
          .agent_level = column_of(agents.level),
          .agent_z = column_of(agents.z),
          .pairs = pairs.data(),
          .gaps = nullptr,
          .states = nullptr,
          .exact_leaves = false,
          .prefetch_agents = agents.size() >= many_agents,
          .prefetch_shapes = view.shape_count >= many_shapes};
}

/// Validates the agents that pairs name. It is cheaper to validate agents in order: all of them, or those from the lowest to
/// the highest index that pairs name, if these are few. An invalid one is then an error only if a pair names it.
void require_valid(const Implementation& implementation, const ShapeSetView& shapes, const Agents& agents,
                   std::span<const Pair> pairs) {
  require_sizes(agents);
  require_heights(shapes, agents);
  const Arguments arguments = arguments_for(shapes, agents, {});
  const bool all_agents_are_valid = agents.size() <= 2 * pairs.size() &&
                                    first_bad_agent(implementation, arguments, agents) == agents.size();
  const auto is_bad = [&](std::uint32_t i) { return i >= agents.size() || !is_valid(arguments, i); };
  const std::size_t i = first_bad(
      pairs.size(),
      [&](std::size_t begin, std::size_t end) {
        const auto [low, high] = implementation.kernels->named(pairs.data(), begin, end);
        if (high >= agents.size()) return false;
        return all_agents_are_valid || (high - low < 2 * (end - begin) &&
                                        implementation.kernels->check(arguments, low, high + std::size_t{1}));
      },
      [&](std::size_t k) { return is_bad(pairs[k].first) || is_bad(pairs[k].second); });
  if (i < pairs.size()) reject_pair(arguments, agents, pairs, i);
}

void require_valid_agents(const ShapeSetView& shapes, const Agents& agents) {
  const FloatingPointStateGuard floats;
  require_sizes(agents);
  require_heights(shapes, agents);
  const Arguments arguments = arguments_for(shapes, agents, {});
  const std::size_t i = first_bad_agent(best_implementation(), arguments, agents);
  if (i < agents.size()) reject(shapes, agents, i);
}

}  // namespace bch::detail

void bch::validate(const ShapeSet& shapes, const Agents& agents) {
  detail::require_valid_agents(shapes.view(), agents);
}
