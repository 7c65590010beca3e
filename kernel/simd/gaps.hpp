// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/base/rounding.hpp"

namespace bch::detail {

/// Holds the thresholds of within() on gaps between discs: up to `leaf`, two leaves are a hit; up to `bound`, blocks
/// are descended into.
///
/// Notation of layout/base/rounding.hpp; d is the distance of the question, r = r_A + r_B, and of two leaf discs, alone,
///
///     hit   <=>  x^2 + y^2 <= (r (1 + 2^-19) + g)^2          g = d (1 + 2^-19), rounded up
///
/// No clearance of at most d is missed. Its gap v = sqrt(x^2 + y^2) * (1 - 2^-20) - r <= d means that sqrt(x^2 + y^2) is
/// at most (r + d) (1 + 19.2 u), by the root, the product, the sum of radii and the difference. The test is passed up to
/// (r + d) (1 + 32 u) (1 - 4.5 u), for the sum of the radii, a product, a sum and both squares. As clearances are never
/// above the distance of outlines, outlines within the distance are a hit, too.
///
/// What it costs. Both look at the same rounded x^2 + y^2. A hit's is at most the square of (r + d) (1 + 34 u) (1 + 3 u), the
/// rounding of g and of the right side included, and v takes off 16 u, less 2 u for its own root and product: v is at
/// most d and 23 u (r + d), (gap_price).
///
/// Bounds: discs that hold leaf discs, and lines beside these. The leaf test passes discs with D - r <= g + 37 u (r + g) +
/// 23 u S + 8 u g, placing others is off by 23 u S + 8 u g, and supports and profiles add roundings of lengths up to
/// 2 S + g, of which they have those of S to spare: 21 u g. So `bound` exceeds g by 128 u (S + g). What is near for
/// sure, by areas within each other, is off by 11 u g, and g exceeds d by 34 u d: (sure_gap) takes 64 u off.
struct Gaps {
  float leaf;   ///< g
  float bound;  ///< between what holds leaf discs
};

constexpr float radius_factor = 1 + 0x1p-19f;  ///< the factor of r
constexpr float sure_gap = 1 - 0x1p-18f;       ///< the factor of g
constexpr double gap_share = 0x1p-19, gap_bound_share = 0x1p-17, gap_price = 1.4e-6;
static_assert(double{radius_factor} - 1 == gap_share && gap_share == 32 * rounding::unit_roundoff);
static_assert(gap_share >= (19.2 + 4.5 + 0.1) * rounding::unit_roundoff);
static_assert(gap_bound_share >= (37 + 2 * 23 + 2 * 8 + 21) * rounding::unit_roundoff);
static_assert(1 - double{sure_gap} >= (11 + 34 + 1) * rounding::unit_roundoff);
static_assert(gap_price >= (34 + 3 - (16 - 2)) * rounding::unit_roundoff);

/// Returns the gaps of two shapes whose reaches are S together, metres. (`Simd` keeps instruction sets from sharing a
/// function.)
template <class Simd>
Gaps gaps(float leaf, float reach) noexcept {
  return {leaf, leaf + static_cast<float>(gap_bound_share) * (reach + leaf)};
}

/// Holds for the stages of within(). Those of collide() know of no gaps, and do not pay for them.
template <class Simd>
concept KnowsGaps = requires {
  Simd::knows_gaps;
};

}  // namespace bch::detail
