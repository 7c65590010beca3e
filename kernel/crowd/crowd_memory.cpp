// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/crowd/crowd_memory.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "kernel/crowd/neighbour_rows.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t crowd_grain = 4096;  ///< pairs or agents a task

}  // namespace

CrowdMemory::Candidates CrowdMemory::find(const ShapeSetView& shapes, const Agents& given, double margin,
                                          const PairFilter& filter, double height_margin) {
  const FloatingPointStateGuard floats;
  Candidates found{given, {}};
  agents = given.size();
  if (is_periodic()) {
    require_valid_agents(shapes, given);
    require_margin(margin);
    periodic.set(shapes, given, options.period, margin);
    found.agents = periodic.agents();
  }
  test.set(
      filter, given.size(),
      found.agents.shape.size() > agents ? periodic.origin_of_image() : std::span<const std::uint32_t>());
  found.pairs = broad_phase.find(shapes, found.agents, margin, options.max_pairs,
                                 test.accepts_all() ? nullptr : &test, height_margin);
  return found;
}

/// Returns pairs of agents, where candidates are pairs of images.
std::span<const Pair> CrowdMemory::named(std::span<const Pair> candidates) {
  if (!is_periodic()) return candidates;
  pairs.resize(candidates.size());
  for_ranges(pairs.size(), crowd_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) pairs[i] = named(candidates[i]);
  });
  return pairs;
}

Rows<Crowd::Neighbour> CrowdMemory::by_agent(std::span<const Pair> of) {
  if (of.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("by_agent: expected fewer than 2^32 pairs, found " + std::to_string(of.size()));
  begin.assign(agents + 1, 0);
  NeighbourRows rows{of, begin, {}};
  const auto for_pairs = [&](auto pass) {
    for_ranges(of.size(), crowd_grain,
               [&](std::size_t first, std::size_t last) { (rows.*pass)(first, last); });
  };
  for_pairs(&NeighbourRows::count);
  neighbours.resize(rows.accumulate());
  rows.neighbours = neighbours;
  for_pairs(&NeighbourRows::fill);
  for_ranges(agents, crowd_grain, [&](std::size_t first, std::size_t last) { rows.sort(first, last); });
  return {begin, neighbours};
}

/// Sorts the rows of by_agent() by distance, and keeps the first of each.
Rows<Crowd::Neighbour> CrowdMemory::nearest(std::span<const Pair> of, std::span<const float> distances,
                                            std::uint32_t max_count) {
  by_agent(of);
  const auto is_nearer = [&](const Crowd::Neighbour& a, const Crowd::Neighbour& b) {
    const float of_a = distances[a.pair], of_b = distances[b.pair];
    return of_a < of_b || (of_a == of_b && a.agent < b.agent);
  };
  const auto row_of = [&](std::size_t agent) {
    return std::span(neighbours).subspan(begin[agent], begin[agent + 1] - begin[agent]);
  };
  for_ranges(agents, crowd_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t agent = first; agent < last; ++agent) {
      const auto row = row_of(agent);
      const auto kept = static_cast<std::ptrdiff_t>(std::min<std::size_t>(max_count, row.size()));
      std::partial_sort(row.begin(), row.begin() + kept, row.end(), is_nearer);
    }
  });
  nearest_begin.assign(1, 0);
  for (std::size_t agent = 0, to = 0; agent < agents; ++agent) {
    const auto kept = row_of(agent).first(std::min<std::size_t>(max_count, row_of(agent).size()));
    std::copy(kept.begin(), kept.end(), neighbours.begin() + static_cast<std::ptrdiff_t>(to));
    nearest_begin.push_back(to += kept.size());
  }
  neighbours.resize(nearest_begin.back());
  return {nearest_begin, neighbours};
}

}  // namespace bch::detail
