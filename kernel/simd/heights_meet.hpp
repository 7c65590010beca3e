// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/geometry.hpp>

namespace bch::detail {

/// Returns whether heights from `bottom` to `top` meet those of a body whose ground is higher by `dz`, metres; touching
/// counts. The slack bounds the rounding of the sums: heights of bodies are within 1e6 m or infinite. (Inlined for certain,
/// so that instruction sets share no function.)
[[gnu::always_inline]] inline bool heights_meet(double bottom, double top, const Heights& body,
                                                double dz) noexcept {
  const double slack = 1e-9 + 0x1p-50 * __builtin_fabs(dz);
  return bottom <= double{body.top} + dz + slack && double{body.bottom} + dz <= top + slack;
}

}  // namespace bch::detail
