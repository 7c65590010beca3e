// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/pairs.hpp>

#include <algorithm>
#include <limits>

#include "kernel/distance/apart_pairs.hpp"
#include "kernel/distance/distance_input.hpp"
#include "kernel/distance/time_of_impact_arguments.hpp"
#include "kernel/runtime/pair_heights.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

namespace {

/// The work of one task.
void answer(const Implementation& implementation, TimeOfImpactArguments arguments,
            std::span<const Pair> pairs, const double* x, const double* y, float* times) {
  ApartPairs open;
  open.collect_apart(implementation, arguments.in, pairs);
  float displacement_x[ApartPairs::capacity], displacement_y[ApartPairs::capacity],
      found[ApartPairs::capacity];
  for (std::size_t k = 0; k < open.size(); ++k) {
    const std::size_t i = open.index(k);
    const auto [first, second] = pairs[i];
    const double sign = second < first ? -1 : 1;
    displacement_x[k] = static_cast<float>(sign * x[i]), displacement_y[k] = static_cast<float>(sign * y[i]);
  }
  arguments.in.pairs = open.pairs().data();
  arguments.x = displacement_x, arguments.y = displacement_y, arguments.time = found;
  implementation.kernels->time_of_impact(arguments, 0, open.size());
  std::fill_n(times, pairs.size(), 0.0f);
  for (std::size_t k = 0; k < open.size(); ++k)
    times[open.index(k)] =
        heights_meet(arguments.in, open.pairs()[k]) ? found[k] : std::numeric_limits<float>::infinity();
}

}  // namespace

void time_of_impact(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                    const Displacements& displacements, std::span<float> times,
                    const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  require_valid({"time_of_impact", "pair", pairs.size()}, displacements, times.size());
  require_on_ground({"time_of_impact", "pair", pairs.size()}, displacements);
  const Implementation& implementation = chosen(wanted, "time_of_impact");
  const ShapeSetView& view = shapes.view();
  require_valid(implementation, view, agents, pairs);

  TimeOfImpactArguments arguments{arguments_for(view, agents, {}), nullptr, nullptr, nullptr};
  for_pair_ranges(pairs.size(), ApartPairs::capacity, [&](std::size_t begin, std::size_t size) {
    answer(implementation, arguments, pairs.subspan(begin, size), displacements.x.data() + begin,
           displacements.y.data() + begin, times.data() + begin);
  });
}

}  // namespace bch
