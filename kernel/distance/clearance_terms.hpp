// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/base/rounding.hpp"

/// Holds the errors of a clearance, derived in kernel/distance/clearance_measure.hpp, in units of u S
/// (`of_extent`) and u D (`of_distance`): S is the sum of both extents, D the distance of the exact centres.
namespace bch::detail::clearance_terms {

namespace r = rounding::terms;

/// The error of sqrt(x^2 + y^2), with |d| <= D + S.
constexpr double root_of_extent = 13.7, root_of_distance = 8.6;
static_assert(root_of_extent >= r::arm + r::position + 2 * r::sum - 0x1p-40);
static_assert(root_of_distance >= r::position + r::sum + r::apart + r::square + 1 - 0x1p-40);

/// The error of the gap: the root, the product, the sum of the radii and the last difference.
constexpr double gap_of_extent = 15.7, gap_of_distance = 10.6;
static_assert(gap_of_extent >= root_of_extent + 1 + 1);
static_assert(gap_of_distance >= root_of_distance + 1 + 1);
static_assert(r::contact_error >= gap_of_extent, "what stored radii include");

/// The reduction by gap_factor, and the most by which a gap is then too small.
constexpr double shortening = 16;
constexpr double short_of_extent = gap_of_extent, short_of_distance = 26.6;
static_assert(shortening >= gap_of_distance);
static_assert(short_of_distance >= gap_of_distance + shortening);

/// The most by which a bound exceeds a gap: the errors of the distance, with D' <= D + 2 S, of the operations
/// after it and of the enlarged sum of the radii, and the most by which a gap is too small.
constexpr double bound_of_extent = 45.4, bound_of_distance = 39.2;
static_assert(bound_of_extent >= (root_of_extent + 4) + 9 + 3 + short_of_extent);
static_assert(bound_of_distance >= (root_of_distance - 1) + 4 + 1 + short_of_distance);

/// The reduction of bounds: in S as a difference, in D as a factor.
constexpr double slack = 64, bound_shortening = 64;
static_assert(slack >= bound_of_extent && bound_shortening >= bound_of_distance);

/// The reduction of the squared distance in may_improve(): twice the relative error of a gap's root, and the
/// rounding of both sides of the comparison.
constexpr double square_shortening = 128;
static_assert(square_shortening >= 2 * (shortening + 3) + 6);

}  // namespace bch::detail::clearance_terms
