// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/interior_lanes.hpp"

namespace bch::detail {
extern const InteriorLoops interior_base;
const InteriorLoops interior_base = InteriorLanes<BaseLanes>::loops();

}  // namespace bch::detail
