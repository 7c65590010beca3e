// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstdint>

#include <bch/agents.hpp>

#include "kernel/simd/agent_columns.hpp"
#include "kernel/simd/arguments.hpp"
#include "kernel/simd/heights_meet.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns whether the heights of two valid agents meet or come within a margin, metres; without Agents::z they always do.
inline bool heights_meet(const Arguments& in, Pair pair, double margin = 0) noexcept {
  if (in.agent_z.first == nullptr) return true;
  using Columns = AgentColumns<void>;
  const auto [a, b] = std::minmax(pair.first, pair.second);
  const auto heights_of = [&](std::uint32_t agent) {
    return in.shapes->heights[Columns::at<std::uint32_t>(in.agent_shape, agent)];
  };
  const Heights of_a = heights_of(a);
  return heights_meet(double{of_a.bottom} - margin, double{of_a.top} + margin, heights_of(b),
                      Columns::number(in.agent_z, b) - Columns::number(in.agent_z, a));
}

}  // namespace bch::detail
