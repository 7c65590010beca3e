// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/pairs.hpp>

#include "kernel/body/body_arguments.hpp"
#include "kernel/distance/within_tasks.hpp"
#include "kernel/runtime/kernels.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/body/body_record.hpp"

namespace bch {

using namespace detail;

void collide(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  check_size({"collide", "pair", pairs.size()}, hits.size(), "hits");
  const Implementation& implementation = chosen(wanted, "collide");
  const BodySetView& view = bodies.view();
  require_valid(implementation, view.ground, agents, pairs);
  BodyArguments arguments{arguments_for(view.ground, agents, pairs), &view};
  arguments.pairs.states = hits.data();
  for_ranges(pairs.size(), pairs_per_task, [&](std::size_t begin, std::size_t end) {
    implementation.kernels->run_bodies(arguments, begin, end);
  });
}

void within(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  require_within(pairs, distances, answers);
  const Implementation& implementation = chosen(wanted, "within");
  const BodySetView& view = bodies.view();
  for_within_tasks(implementation, view.ground, agents, pairs, distances, answers,
                   [&](const Arguments& in, std::size_t size) {
                     implementation.kernels->run_bodies({in, &view}, 0, size);
                   });
}

}  // namespace bch
