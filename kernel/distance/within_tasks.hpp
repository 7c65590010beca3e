// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include <bch/pairs.hpp>

#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/distance/distance_input.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "kernel/simd/gaps.hpp"

namespace bch::detail {

/// Returns the largest gap of leaf discs for a distance; see Gaps.
inline float gap_of(double distance) noexcept {
  return rounding::round_up(std::min(distance, static_cast<double>(largest_limit)) * (1 + gap_fraction));
}

/// Validates, and calls run(arguments, size) for the pairs of each task.
template <class Run>
void for_within_tasks(const Implementation& implementation, const ShapeSetView& view, const Agents& agents,
                      std::span<const Pair> pairs, std::span<const double> distances,
                      std::span<std::uint8_t> answers, const Run& run) {
  require_valid(implementation, view, agents, pairs);
  for_pair_ranges(pairs.size(), pairs_per_task, [&](std::size_t begin, std::size_t size) {
    float gaps[pairs_per_task];
    for (std::size_t i = 0; i < size; ++i) gaps[i] = gap_of(distances[distances.size() == 1 ? 0 : begin + i]);
    Arguments arguments = arguments_for(view, agents, pairs.subspan(begin, size));
    arguments.gaps = gaps;
    arguments.states = answers.data() + begin;
    run(arguments, size);
  });
}

/// Checks the sizes and distances of within().
inline void require_within(std::span<const Pair> pairs, std::span<const double> distances,
                           std::span<const std::uint8_t> answers) {
  const QueryName context{"within", "pair", pairs.size()};
  check_size(context, answers.size(), "answers");
  require_distances(context, distances);
}

}  // namespace bch::detail
