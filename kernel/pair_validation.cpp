// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/pair_validation.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "kernel/collide.hpp"
#include "kernel/standard_floats.hpp"
#include "kernel/validation.hpp"

namespace bch {
namespace kernel {
namespace {

using Range = tbb::blocked_range<std::size_t>;

/// From here on agents are prefetched: 3 MB of them. Below, that costs 1 % (and 13 % for single cylinders).
constexpr std::size_t many_agents = 100'000;

/// The lowest index in [0, count) for which `bad` holds, or count. `all_good(begin, end)` says quickly where there is
/// nothing to find.
template <class AllGood, class Bad>
std::size_t first_bad(std::size_t count, AllGood all_good, Bad bad) {
  const auto search = [&](const Range& range, std::size_t found) {
    const StandardFloats floats;
    if (range.begin() >= found || all_good(range.begin(), range.end())) return found;
    for (std::size_t i = range.begin(); i < range.end() && i < found; ++i)
      if (bad(i)) return i;
    return found;
  };
  const Range all(0, count, pairs_per_task);
  if (count <= pairs_per_task) return search(all, count);
  return tbb::parallel_reduce(all, count, search,
                              [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

std::size_t first_bad_agent(const Implementation& implementation, const ShapeSet& shapes,
                            const Agents& agents) {
  const ShapeSetView view = shapes.view();
  const Arguments arguments = arguments_for(view, agents, {});
  return first_bad(
      agents.size(),
      [&](std::size_t begin, std::size_t end) { return implementation.check(arguments, begin, end); },
      [&](std::size_t i) { return !is_valid(shapes, agents, i); });
}

bool indices_are_below(std::span<const Pair> pairs, std::uint32_t agents) {
  std::uint32_t bad = 0;
  for (const Pair& pair : pairs) bad += (pair.first >= agents) | (pair.second >= agents);
  return bad == 0;
}

[[noreturn]] void reject_pair(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                              std::size_t i) {
  const std::string place = "pair " + std::to_string(i) + ": ";
  for (const std::uint32_t agent : {pairs[i].first, pairs[i].second}) {
    if (agent >= agents.size())
      throw std::invalid_argument(place + "agent " + std::to_string(agent) + " of " +
                                  std::to_string(agents.size()));
    if (is_valid(shapes, agents, agent)) continue;
    try {
      reject(shapes, agents, agent);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(place + error.what());
    }
  }
  throw std::logic_error(place + "rejected without a reason");
}

}  // namespace

const Implementation& chosen(const Implementation* wanted, const char* query) {
  const Implementation& implementation = wanted ? *wanted : best_implementation();
  if (!implementation.supported())
    throw std::invalid_argument(std::string(query) + ": this processor does not run '" + implementation.name +
                                "'");
  return implementation;
}

Arguments arguments_for(const ShapeSetView& view, const Agents& agents, std::span<const Pair> pairs) {
  return {.shapes = &view,
          .agent_shape = agents.shape.data(),
          .agent_x = agents.x.data(),
          .agent_y = agents.y.data(),
          .agent_heading = agents.heading.data(),
          .agent_level = agents.level.empty() ? nullptr : agents.level.data(),
          .pairs = pairs.data(),
          .codes = nullptr,
          .mark_near_misses = false,
          .prefetch = agents.size() >= many_agents};
}

/// Where there are fewer agents than pairs name, looking at all of them, in order, is cheaper; a bad one then still
/// has to be named by a pair.
void require_valid(const Implementation& implementation, const ShapeSet& shapes, const Agents& agents,
                   std::span<const Pair> pairs) {
  require_sizes(agents);
  const bool all_agents_are_valid =
      agents.size() <= 2 * pairs.size() && first_bad_agent(implementation, shapes, agents) == agents.size();
  const auto is_bad = [&](std::uint32_t i) { return i >= agents.size() || !is_valid(shapes, agents, i); };
  const std::size_t i = first_bad(
      pairs.size(),
      [&](std::size_t begin, std::size_t end) {
        return all_agents_are_valid && indices_are_below(pairs.subspan(begin, end - begin),
                                                         static_cast<std::uint32_t>(agents.size()));
      },
      [&](std::size_t k) { return is_bad(pairs[k].first) || is_bad(pairs[k].second); });
  if (i < pairs.size()) reject_pair(shapes, agents, pairs, i);
}

}  // namespace kernel

void validate(const ShapeSet& shapes, const Agents& agents) {
  kernel::require_sizes(agents);
  const std::size_t i = kernel::first_bad_agent(kernel::best_implementation(), shapes, agents);
  if (i < agents.size()) kernel::reject(shapes, agents, i);
}

}  // namespace bch
