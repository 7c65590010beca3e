// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/collide/collide.hpp"

#include <stdexcept>
#include <string>

#include "kernel/collide/answer.hpp"
#include "kernel/runtime/floating_point_state.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "kernel/runtime/validation.hpp"

namespace bch {

void collide(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const QueryOptions& options) {
  const kernel::FloatingPointStateGuard floats;
  const bool solid = options.semantics == Semantics::solid;
  if (hits.size() != pairs.size())
    throw std::invalid_argument("collide: " + std::to_string(pairs.size()) + " pairs but " +
                                std::to_string(hits.size()) + " hits");
  if (!solid && options.semantics != Semantics::boundary)
    throw std::invalid_argument("collide: no semantics is " +
                                std::to_string(static_cast<int>(options.semantics)) +
                                ", only boundary (0) and solid (1)");
  if (solid && !shapes.solid())
    throw std::invalid_argument(
        "collide: solid semantics needs outlines, and the set does not have that of every shape");
  const bool exact_leaves = kernel::exact_leaves(options.leaves, "collide");
  const kernel::Implementation& implementation = kernel::chosen(options.implementation, "collide");
  const ShapeSetView& view = shapes.view();
  kernel::require_sizes(agents);
  kernel::Arguments arguments = kernel::arguments_for(view, agents, pairs);
  arguments.codes = hits.data();
  arguments.mark_near_misses = solid;
  arguments.exact_leaves = exact_leaves && shapes.exact_leaves();
  if (kernel::answer_if_valid(implementation, arguments, agents, pairs.size())) return;
  kernel::require_valid(implementation, view, agents, pairs);
  kernel::for_ranges(pairs.size(), kernel::pairs_per_task, [&](std::size_t begin, std::size_t end) {
    kernel::answer(implementation, arguments, agents, begin, end);
  });
}

}  // namespace bch
