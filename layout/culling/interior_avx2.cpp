// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/interior_lanes.hpp"

namespace bch::detail {
namespace {

struct Local {};

}  // namespace

extern const InteriorLoops interior_avx2;
const InteriorLoops interior_avx2 = InteriorLanes<xsimd::avx2, Local>::loops();

}  // namespace bch::detail
