// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/answer.hpp"

#include "kernel/containment.hpp"

namespace bch::kernel {

void answer(const Implementation& implementation, const Arguments& arguments, const Agents& agents,
            std::size_t begin, std::size_t end) noexcept {
  implementation.run(arguments, begin, end);
  if (!arguments.mark_near_misses) return;
  for (std::size_t i = begin; i < end; ++i)
    if (arguments.codes[i] == near_miss)
      arguments.codes[i] =
          one_contains_other(*arguments.shapes, agents, arguments.pairs[i]) ? overlap : apart;
    else
      arguments.codes[i] &= overlap;
}

}  // namespace bch::kernel
