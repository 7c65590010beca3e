// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/pairs.hpp>

#include "kernel/collide/answer.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "kernel/runtime/validation.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

void collide(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const CollideOptions& options) {
  const FloatingPointStateGuard floats;
  check_size({"collide", "pair", pairs.size()}, hits.size(), "hits");
  const bool exact = exact_leaves(shapes, options.leaves, "collide");
  const Implementation& implementation = chosen(options.implementation, "collide");
  const ShapeSetView& view = shapes.view();
  require_sizes(agents);
  Arguments arguments = arguments_for(view, agents, pairs);
  arguments.states = hits.data();
  arguments.exact_leaves = exact;
  require_valid(implementation, view, agents, pairs);
  for_ranges(pairs.size(), pairs_per_task,
             [&](std::size_t begin, std::size_t end) { answer(implementation, arguments, begin, end); });
}

}  // namespace bch
