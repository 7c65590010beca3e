// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/base/rounding.hpp"

namespace bch::detail {

/// Holds the thresholds of within() on gaps between discs: two leaves whose gap is at most `leaf` are a hit; blocks whose
/// gap is at most `bound` are descended into.
///
/// As in layout/base/rounding.hpp, u = 2^-24, and S is the sum of both extents (largest distances of a shape's points
/// from its origin). d is the distance that within() was given, r = r_A + r_B, and (x, y) leads from one centre to the
/// other. Two leaf discs are a hit, without regard to their ancestors, if
///
/// (1)  hit   <=>  x^2 + y^2 <= (r (1 + 2^-19) + g)^2,     g = d (1 + 2^-19), rounded up.
///
/// Nothing is missed. clearance() computes v = sqrt(x^2 + y^2) (1 - 2^-20) - r. Let e = sqrt(x^2 + y^2).
///
/// (2)  v <= d  =>  e <= (r + d) (1 + 19.2 u)             root, product, sum of radii, difference
/// (3)  e <= (r + d) (1 + 32 u) (1 - 4.5 u)  =>  hit      sum of radii, product, sum, both squares
///
/// So v <= d is a hit. Clearances are never above the distance of outlines, so outlines within d are a hit, too.
///
/// Error of a hit (gap_price): how far v may exceed d. (1) and v use the same rounded x^2 + y^2.
///
/// (4)  hit  =>  e <= (r + d) (1 + 34 u) (1 + 3 u)        with the rounding of g and of the right side
/// (5)  hit  =>  v <= d + 23 u (r + d)                    (4), less 16 u by the factor of v, plus 2 u by its root and
///                                                        product
///
/// Bounds. `bound` is for discs that enclose leaf discs, and for lines that separate leaf discs. D is the exact
/// distance of the centres of two leaf discs. Placing the two in float is off by at most 23 u S + 8 u g. So e differs
/// from D by at most 23 u S + 8 u g. (6) is (4) plus this error. Placing the enclosing discs is off by as much again,
/// which is (7).
///
/// (6)  hit  =>  D - r <= g + 37 u (r + g) + 23 u S + 8 u g
/// (7)  placing the enclosing discs is off by 23 u S + 8 u g
/// (8)  supports and profiles round lengths of up to 2 S + g; their own margins cover the errors of the part 2 S, and
///      the errors of the part g are at most 21 u g
/// (9)  bound = g + 128 u (S + g) exceeds the sum of (6) to (8)
///
/// Accepting (sure_gap). Inscribed discs and profiles may accept only pairs within d. They compare a distance that is
/// wrong by up to 11 u g, and g exceeds d by up to 34 u d. So they compare it with g (1 - 64 u).
struct Gaps {
  float leaf;   ///< g
  float bound;  ///< of discs that hold leaf discs
};

constexpr float radius_factor = 1 + 0x1p-19f;  ///< the factor of r
constexpr float sure_gap = 1 - 0x1p-18f;       ///< the factor of g
constexpr double gap_fraction = 0x1p-19, gap_bound_fraction = 0x1p-17, gap_price = 1.4e-6;
static_assert(double{radius_factor} - 1 == gap_fraction && gap_fraction == 32 * rounding::unit_roundoff);
static_assert(gap_fraction >= (19.2 + 4.5 + 0.1) * rounding::unit_roundoff);
static_assert(gap_bound_fraction >= (37 + 2 * 23 + 2 * 8 + 21) * rounding::unit_roundoff);
static_assert(1 - double{sure_gap} >= (11 + 34 + 1) * rounding::unit_roundoff);
static_assert(gap_price >= (34 + 3 - (16 - 2)) * rounding::unit_roundoff);

/// Returns the gaps of two shapes whose extents are S together, metres. (`Simd` gives each instruction set a function
/// of its own, which the linker cannot merge.)
template <class Simd>
Gaps gaps(float leaf, float max_extent) noexcept {
  return {leaf, leaf + static_cast<float>(gap_bound_fraction) * (max_extent + leaf)};
}

/// Is true for the stages of within(). The stages of collide() have no gaps, and contain no code for them.
template <class Simd>
concept KnowsGaps = requires {
  Simd::knows_gaps;
};

}  // namespace bch::detail
