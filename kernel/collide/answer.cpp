// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/collide/answer.hpp"

#include "kernel/collide/containment.hpp"
#include "kernel/runtime/kernels.hpp"

namespace bch::detail {
namespace {

/// Decides the pairs of which one outline may contain the other.
void decide_containment(const Arguments& arguments, const Agents& agents, std::size_t begin,
                        std::size_t end) noexcept {
  if (!arguments.solid) return;
  for (std::size_t i = begin; i < end; ++i)
    if (arguments.codes[i] == may_contain)
      arguments.codes[i] =
          one_contains_other(*arguments.shapes, agents, arguments.pairs[i]) ? overlap : apart;
    else
      arguments.codes[i] &= overlap;
}

}  // namespace

void answer(const Implementation& implementation, const Arguments& arguments, const Agents& agents,
            std::size_t begin, std::size_t end) noexcept {
  implementation.kernels->run(arguments, begin, end);
  decide_containment(arguments, agents, begin, end);
}

bool answer_if_valid(const Implementation& implementation, const Arguments& arguments, const Agents& agents,
                     std::size_t count) noexcept {
  if (count == 0 || count > chunk_size ||
      !implementation.kernels->run_if_valid(arguments, static_cast<std::uint32_t>(count)))
    return false;
  decide_containment(arguments, agents, 0, count);
  return true;
}

}  // namespace bch::detail
