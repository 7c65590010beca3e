// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosing_disc/disc_lanes.hpp"

namespace bch::detail {

void solve_discs_base(const DiscSets& sets) noexcept {
  DiscLanes<BaseLanes>::solve(sets);
}

}  // namespace bch::detail
