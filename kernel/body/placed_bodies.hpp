// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/body/sphere_test.hpp"
#include "layout/body/body_record.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {

/// Holds two bodies, and how the second lies in the first one's frame. (Inlined for certain, so that instruction sets share no function.)
struct PlacedBodies {
  const float *a, *b;  ///< records
  SpaceTransformOf<float> b_in_a;
  float gap = 0;  ///< spheres that are apart by at most this meet; metres

  /// Returns the gap that bounds allow, so that none misses what the test of spheres accepts, where they have a margin for reaches.
  [[gnu::always_inline]] float wide_gap() const noexcept {
    return gap + static_cast<float>(rounding::bound_gap_margin) * __builtin_fabsf(gap);
  }
  /// Returns how much more other bounds have to reach, metres.
  [[gnu::always_inline]] float margin() const noexcept {
    return static_cast<float>(rounding::bound_margin) * (header_of(a).max_extent + header_of(b).max_extent) +
           wide_gap();
  }
};

}  // namespace bch::detail
