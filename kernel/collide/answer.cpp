// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/collide/answer.hpp"

#include <bch/agents.hpp>

#include "kernel/collide/containment.hpp"
#include "kernel/runtime/kernels.hpp"
#include "kernel/runtime/pair_heights.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {
namespace {

/// Rejects the pairs whose heights do not meet.
void compare_heights(const Arguments& in, std::size_t begin, std::size_t end) noexcept {
  if (in.agent_z.first == nullptr) return;
  for (std::size_t i = begin; i < end; ++i)
    if (in.states[i] != apart && !heights_meet(in, in.pairs[i])) in.states[i] = apart;
}

/// Decides the pairs in which one outline may contain the other.
void decide_containment(const Arguments& in, std::size_t begin, std::size_t end) noexcept {
  if (in.shapes->shape_contours == nullptr) return;
  for (std::size_t i = begin; i < end; ++i) {
    if (in.states[i] != may_contain) {
      in.states[i] &= overlap;
      continue;
    }
    in.states[i] = one_contains_other(in, in.pairs[i]) ? overlap : apart;
  }
}

}  // namespace

void answer(const Implementation& implementation, const Arguments& arguments, std::size_t begin,
            std::size_t end) noexcept {
  const Kernels& kernels = *implementation.kernels;
  (arguments.gaps != nullptr ? kernels.run_within : kernels.run)(arguments, begin, end);
  compare_heights(arguments, begin, end);
  decide_containment(arguments, begin, end);
}

}  // namespace bch::detail
