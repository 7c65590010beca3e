// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/time_of_impact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernel/distance/time_of_impact_arguments.hpp"
#include "kernel/runtime/floating_point_state.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/part_items.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/rounding.hpp"

namespace bch {

using namespace detail;

namespace {

/// Pairs a task.
constexpr std::size_t grain = 1024;

/// Bodies in slabs or at different heights meet where their first parts do.
void find_first(const Implementation& implementation, const TimeOfImpactArguments& whole,
                const Agents& agents, std::span<const Pair> pairs, const float* way_x, const float* way_y,
                float* times) {
  const ShapeSetView parts = parts_as_shapes(*whole.in.shapes);
  PartItems items;
  items.expand(*whole.in.shapes, agents, pairs);
  std::vector<float> x(items.size()), y(items.size()), found(items.size());
  for (std::size_t k = 0; k < items.size(); ++k) {
    x[k] = way_x[items.origin(k).pair], y[k] = way_y[items.origin(k).pair];
  }
  const Agents part_agents = items.agents();
  const TimeOfImpactArguments arguments{arguments_for(parts, part_agents, items.pairs()), x.data(), y.data(),
                                        found.data()};
  implementation.kernels->time_of_impact(arguments, 0, items.size());
  std::fill_n(times, pairs.size(), std::numeric_limits<float>::infinity());
  for (std::size_t k = 0; k < items.size(); ++k) {
    float& time = times[items.origin(k).pair];
    time = std::min(time, found[k]);
  }
}

/// The work of one task. Most overlapping pairs are found sooner by collide(), which has culling data for
/// that.
void answer(const Implementation& implementation, TimeOfImpactArguments arguments, const Agents& agents,
            std::span<const Pair> pairs, const double* x, const double* y, float* times) {
  std::uint8_t codes[grain];
  arguments.in.pairs = pairs.data();
  arguments.in.codes = codes;
  const bool of_parts = asks_parts(*arguments.in.shapes, agents);
  (of_parts ? implementation.kernels->run_in_slabs : implementation.kernels->run)(arguments.in, 0,
                                                                                  pairs.size());

  Pair open[grain];
  std::uint32_t which[grain];
  float way_x[grain], way_y[grain], found[grain];
  std::size_t count = 0;
  // There are two loops, neither of which has a branch that depends on an answer.
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    times[i] = 0;
    which[count] = i;
    count += codes[i] == apart;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t i = which[k];
    const auto [first, second] = pairs[i];
    const double sign = second < first ? -1 : 1;
    way_x[k] = static_cast<float>(sign * x[i]), way_y[k] = static_cast<float>(sign * y[i]);
    open[k] = pairs[i];
  }
  arguments.in.pairs = open;
  arguments.x = way_x, arguments.y = way_y, arguments.time = found;
  if (of_parts)
    find_first(implementation, arguments, agents, {open, count}, way_x, way_y, found);
  else
    implementation.kernels->time_of_impact(arguments, 0, count);
  for (std::size_t k = 0; k < count; ++k) times[which[k]] = found[k];
}

void require_sizes(const Displacements& displacements, std::size_t times, std::size_t pairs) {
  const auto require = [pairs](std::size_t size, const char* name) {
    if (size != pairs)
      throw std::invalid_argument("time_of_impact: " + std::to_string(pairs) + " pairs but " +
                                  std::to_string(size) + " " + name);
  };
  require(displacements.x.size(), "displacements in x");
  require(displacements.y.size(), "displacements in y");
  require(times, "times");
}

void require_valid(const Displacements& displacements) {
  const auto good = [](double length) { return std::abs(length) <= rounding::largest_position; };
  for (std::size_t i = 0; i < displacements.x.size(); ++i) {
    if (good(displacements.x[i]) && good(displacements.y[i])) continue;
    std::ostringstream message;
    message << "time_of_impact: pair " << i << ": displacement (" << displacements.x[i] << ", "
            << displacements.y[i] << ") m is not within +-1e9";
    throw std::invalid_argument(message.str());
  }
}

}  // namespace

void time_of_impact(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                    const Displacements& displacements, std::span<float> times, const QueryOptions& options) {
  const FloatingPointStateGuard floats;
  require_sizes(displacements, times.size(), pairs.size());
  const Implementation& implementation = chosen(options, "time_of_impact");
  const ShapeSetView& view = shapes.view();
  require_valid(implementation, view, agents, pairs);
  require_valid(displacements);

  TimeOfImpactArguments arguments{arguments_for(view, agents, {}), nullptr, nullptr, nullptr};
  arguments.in.solid = view.slab_parts != nullptr;
  for_pair_ranges(pairs.size(), grain, [&](std::size_t begin, std::size_t size) {
    answer(implementation, arguments, agents, pairs.subspan(begin, size), displacements.x.data() + begin,
           displacements.y.data() + begin, times.data() + begin);
  });
}

}  // namespace bch
