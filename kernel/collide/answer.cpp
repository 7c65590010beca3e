// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/collide/answer.hpp"

#include <bch/agents.hpp>

#include "kernel/collide/containment.hpp"
#include "kernel/runtime/kernels.hpp"
#include "kernel/simd/agent_columns.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {
namespace {

bool in_slabs(const Arguments& in) noexcept {
  return in.shapes->slab_parts != nullptr || in.agent_z.first != nullptr;
}

/// Decides the pairs of which one outline may contain the other.
void decide_containment(const Arguments& in, std::size_t begin, std::size_t end) noexcept {
  if (in.shapes->shape_contours == nullptr) return;
  for (std::size_t i = begin; i < end; ++i) {
    if (in.codes[i] != may_contain) {
      in.codes[i] &= overlap;
      continue;
    }
    const auto [a, b] = in.pairs[i];
    const auto shape_of = [&](std::uint32_t agent) {
      return AgentColumns<void>::at<std::uint32_t>(in.agent_shape, agent);
    };
    in.codes[i] = one_contains_other(in, a, shape_of(a), b, shape_of(b)) ? overlap : apart;
  }
}

}  // namespace

void answer(const Implementation& implementation, const Arguments& arguments, std::size_t begin,
            std::size_t end) noexcept {
  const Kernels& kernels = *implementation.kernels;
  const bool about_gaps = arguments.gaps != nullptr;
  if (in_slabs(arguments))
    return (about_gaps ? kernels.run_within_in_slabs : kernels.run_in_slabs)(arguments, begin, end);
  (about_gaps ? kernels.run_within : kernels.run)(arguments, begin, end);
  decide_containment(arguments, begin, end);
}

bool answer_if_valid(const Implementation& implementation, const Arguments& arguments,
                     std::size_t count) noexcept {
  if (count == 0 || count > chunk_size || in_slabs(arguments) ||
      !implementation.kernels->run_if_valid(arguments, static_cast<std::uint32_t>(count)))
    return false;
  decide_containment(arguments, 0, count);
  return true;
}

}  // namespace bch::detail
