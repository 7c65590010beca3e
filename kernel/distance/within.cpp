// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>

#include <bch/clearance.hpp>

#include "kernel/body/body_arguments.hpp"
#include "kernel/collide/answer.hpp"
#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/distance/distance_input.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "kernel/simd/gaps.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/body/body_record.hpp"

namespace bch {

using namespace detail;

namespace {

/// Returns the gap of leaf discs that a distance makes; see Gaps.
float gap_of(double distance) noexcept {
  return rounding::round_up(std::min(distance, static_cast<double>(largest_limit)) * (1 + gap_share));
}

/// Validates, and calls run(arguments, size) for the pairs of each task.
template <class Run>
void for_tasks(const Implementation& implementation, const ShapeSetView& view, const Agents& agents,
               std::span<const Pair> pairs, std::span<const double> distances,
               std::span<std::uint8_t> answers, const Run& run) {
  require_valid(implementation, view, agents, pairs);
  for_pair_ranges(pairs.size(), pairs_per_task, [&](std::size_t begin, std::size_t size) {
    float gaps[pairs_per_task];
    for (std::size_t i = 0; i < size; ++i) gaps[i] = gap_of(distances[distances.size() == 1 ? 0 : begin + i]);
    Arguments arguments = arguments_for(view, agents, pairs.subspan(begin, size));
    arguments.gaps = gaps;
    arguments.codes = answers.data() + begin;
    run(arguments, size);
  });
}

/// Requires the sizes, and the distances.
void require_input(std::span<const Pair> pairs, std::span<const double> distances,
                   std::span<const std::uint8_t> answers) {
  const Asked asked{"within", "pair", pairs.size()};
  require_as_many(asked, answers.size(), "answers");
  require_distances(asked, distances);
}

}  // namespace

void within(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
            std::span<const double> distances, std::span<std::uint8_t> answers, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_input(pairs, distances, answers);
  const Implementation& implementation = chosen(options, "within");
  for_tasks(implementation, shapes.view(), agents, pairs, distances, answers,
            [&](const Arguments& in, std::size_t size) { answer(implementation, in, 0, size); });
}

void within(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  require_input(pairs, distances, answers);
  const Implementation& implementation = chosen({.implementation = wanted}, "within");
  const BodySetView& view = bodies.view();
  for_tasks(implementation, view.ground, agents, pairs, distances, answers,
            [&](const Arguments& in, std::size_t size) {
              implementation.kernels->run_bodies({in, &view}, 0, size);
            });
}

}  // namespace bch
