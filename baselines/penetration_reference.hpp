// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "baselines/cut_lists.hpp"

namespace bch::baselines {

/// Holds how far a pair's first agent has to move, and where to.
struct PenetrationDepth {
  float depth;
  double x, y;
  friend bool operator==(const PenetrationDepth&, const PenetrationDepth&) = default;
};

/// Returns how far to move until the first agent's discs lie behind a line across the direction and the other's
/// before it. Tests one disc after the other, with the rounding of kernel/penetration/penetration.cpp. The
/// result is the largest such distance over all pairs of discs.
PenetrationDepth penetration_along(const CutLists& cuts, const Agents& agents, Pair pair, Vec2 direction);

/// Returns the shortest move among k directions evenly spread from the x axis on; in a tie the first of 0, k /
/// 2, 1, k / 2 + 1 ... for the agent of the lower index.
PenetrationDepth penetration(const CutLists& cuts, const Agents& agents, Pair pair, std::uint32_t k);

}  // namespace bch::baselines
