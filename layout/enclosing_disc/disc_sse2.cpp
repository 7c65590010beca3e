// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosing_disc/disc_lanes.hpp"

namespace bch::detail {
namespace {

struct Local {};

}  // namespace

void solve_discs_sse2(const DiscSets& sets) noexcept {
  DiscLanes<xsimd::sse2, Local>::solve(sets);
}

}  // namespace bch::detail
