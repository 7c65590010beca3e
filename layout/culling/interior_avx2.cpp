// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/interior_lanes.hpp"

namespace bch::detail {
namespace {

struct Avx2Lanes : Lanes<xsimd::avx2, Avx2Lanes> {};

}  // namespace

extern const InteriorLoops interior_avx2;
const InteriorLoops interior_avx2 = InteriorLanes<Avx2Lanes>::loops();

}  // namespace bch::detail
