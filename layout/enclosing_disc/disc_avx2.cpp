// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosing_disc/disc_lanes.hpp"

namespace bch::detail {
namespace {

struct Avx2Lanes : Lanes<xsimd::avx2, Avx2Lanes> {};

}  // namespace

void solve_discs_avx2(const DiscSets& sets) noexcept {
  DiscLanes<Avx2Lanes>::solve(sets);
}

}  // namespace bch::detail
