// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <cstddef>

#include <bch/agents.hpp>

#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns whether an agent is a valid argument of a query; NaN is not.
inline bool is_valid(const ShapeSetView& shapes, const Agents& agents, std::size_t i) noexcept {
  return agents.shape[i] < shapes.shape_count &&
         (agents.level.empty() || agents.level[i] < shapes.level_count) &&
         std::abs(agents.x[i]) <= rounding::largest_position &&
         std::abs(agents.y[i]) <= rounding::largest_position &&
         std::abs(agents.heading[i]) <= rounding::largest_heading;
}

/// Throws std::invalid_argument where the spans differ in length, or there are more than 2^32 - 1 agents.
void require_sizes(const Agents& agents);

/// Throws std::invalid_argument saying what is wrong with an agent for which is_valid() is false.
[[noreturn]] void reject(const ShapeSetView& shapes, const Agents& agents, std::size_t i);

}  // namespace bch::detail
