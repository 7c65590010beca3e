// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/pairs.hpp>

#include "kernel/collide/answer.hpp"
#include "kernel/distance/within_tasks.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

void within(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  require_within(pairs, distances, answers);
  const Implementation& implementation = chosen(wanted, "within");
  for_within_tasks(implementation, shapes.view(), agents, pairs, distances, answers,
                   [&](const Arguments& in, std::size_t size) { answer(implementation, in, 0, size); });
}

}  // namespace bch
