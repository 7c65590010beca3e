// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/interior_lanes.hpp"

namespace bch::detail {
extern const InteriorLoops interior_sse2;
const InteriorLoops interior_sse2 = InteriorLanes<BaseLanes>::loops();

}  // namespace bch::detail
