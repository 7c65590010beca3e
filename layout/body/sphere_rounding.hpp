// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/base/rounding.hpp"

/// Proves by how much spheres have to be enlarged so that a query in float never misses what they hold. Notation, names and the
/// horizontal part are those of layout/base/rounding.hpp; a body's extent P is the largest distance of a point of its spheres from its
/// origin, so that |a| <= P_A and r_A <= P_A for every sphere, and lengths are those of space.
///
/// The query (every kernel and the reference, same operations, same order; no contraction):
///
///     d.z    = float(z_B - z_A)                                the difference in double
///     p.z    = d.z + b.z                                       p.x, p.y and d.x, d.y as there
///     hit   <=>  ((p.x - a.x)^2 + (p.y - a.y)^2) + (p.z - a.z)^2 <= (r_A + r_B)^2
///
/// Spheres that have a point in common have D <= r_A + r_B <= S and |d| <= |a| + D + |b| <= 2 S. Beside the horizontal
/// errors, 7.1 u P_B + 4.6 u |d| + u (|d| + |b|) + u D, the vertical ones are
///
///     (rise)      u |d| + u (|d| + |b|) + u D     d.z to float, the sum, the difference
///     (cube)      1.5 u D                         squares and two sums: 3 u of the square are 1.5 u of its root
///
/// and all together, with (radii), the sides of the comparison are off by at most
///
///     7.1 u S + 9.2 u S + 3 u S + u S + 2 u S + 3 u S + u S + 1.5 u S + 1.5 u S  <=  29.3 u S  <=  30 u S      (3)
///
/// No miss: radii are enlarged by 30 u P each. What the float test accepts is at most another 30 u S apart, (sphere_error).
///
/// Bounds. What a query leaves out by bounds must not hold spheres that the float test accepts: it tests whether bounds come within
/// (bound_margin) S. A node's disc and heights hold its spheres exactly, with centres in the box of P about the origin, |C| <= sqrt(2) P
/// on the ground, and R <= 3 P. Two nodes of accepted spheres have |d| <= 2 S and are tested as two spheres are, so that arm and sum grow by
/// sqrt(2), and apart, square and radii are of R_A + R_B <= 3 S:
///
///     (nodes)     10.1 u S + 9.2 u S + 3.5 u S + 3 (1 + 1 + 1.5) u S + 30 u S  <=  64 u S                  (4)
///     (heights)   30 u S, and 3 roundings of sums of up to 6 S: |d.z| <= 2 S, heights and the margin      (5)
///
/// A node is compared with supports of the other body as if it were the supports of its own body; where that has no support_margin, the
/// node's part of (2), 287 u S, is missing, and its own products add 4 u (sqrt(2) + 2) P and its turned direction 15 u sqrt(2) P:
///
///     (axes)      287 u S + 13.7 u S + 21.3 u S + 3 u S  <=  330 u S                                       (6)
///
/// Points of two accepted spheres are within 30 u S of each other, so their heights above their own grounds differ by less than the grounds
/// and bound_margin do: by at most band_overlap where equal bands alone are compared.
///
/// Distances. With v = D - (r_A + r_B), |a| + r_A <= P_A and |d| <= |a| + |b| + D the float root of the square is off by
///
///     9.1 u |b| + 7.6 u |d| + (2 + 1.5 + 1) u D  <=  16.7 u S + 12.1 u v                                   (7)
///
/// and clearance() is, where no test of a hit accepts the two,
///
///     w = (sqrt(square) far - R) near        R = r_A + r_B,  far = 1 + 8 u,  near = 1 - 24 u
///
/// Never too large: the product adds 9 u D, the sum of radii u S, the difference and the last product u v each. Published radii have
/// room for what is of S, near takes off what is of v, (distance). Above 0: a square that the test refuses has a root of at least
/// R (1 - 1.5 u), and far lifts it above R.
///
/// Within d: the test with gap g = d (1 + 32 u), radii^2 = ((r_A + g) + r_B)^2, accepts all with w <= d. These have v <= d (1 + 26 u) and a
/// root of at most (R + d (1 + 27 u)) (1 - 6 u), and the right side's own is at least (R + g) (1 - 3.5 u).
///
/// Bounds of spheres that may be within a gap g: what is accepted, or has w <= g, has v <= 30 u S + 48 u g + g; bounds that are apart by g, with
/// |d| <= 2 S + g, bring 16 u g where they are placed, 11 u g along axes and 4 u g for squares and sums: (bound_share).
namespace bch::detail::rounding {

namespace terms {

constexpr double rise = 2 + 3 + 1;  // of S, by |d| <= 2 S
constexpr double cube = 1.5;
constexpr double sphere_error = 30;
static_assert(sphere_error >= arm + 2 * position + (2 + 1) * sum + apart + rise + cube + radii + higher,
              "(3)");

constexpr double nodes = 64;
static_assert(nodes >=
                  root_2 * (arm + sum) + 2 * position + 2 * sum + 3 * (apart + square + radii) + sphere_error,
              "(4)");
constexpr double node_heights = 48;
static_assert(node_heights >= sphere_error + 3 * 6, "(5)");
constexpr double axes = 330;
static_assert(axes >= support_error + query_error + 4 * (root_2 + 2) + 15 * root_2 + 3, "(6)");

constexpr double length_b = arm + 2 * sum, length_d = position + 3 * sum,
                 length_between = 2 * apart + cube + 1;
constexpr double of_distance = length_d + length_between, lifted = 8, shortened = 24;  // of D
static_assert(of_distance <= 12.1 + 0x1p-40 && length_b + length_d <= 16.7 + 0x1p-40, "(7)");
static_assert(sphere_error >= of_distance + lifted + 1 + 1 && of_distance + lifted + 1 >= length_b + length_d,
              "what is of S");
static_assert(shortened >= of_distance + lifted + 1 + 2, "(distance)");
static_assert(lifted > 1.5 + 1 + 1, "the root and the product");
constexpr double of_gap = 48 + 16 + 11 + 4;
static_assert(48 >= shortened + 4 + of_distance);

}  // namespace terms

/// The margin of bounds of spheres, times the sum of both extents.
constexpr double bound_margin = 400 * unit_roundoff;
static_assert(bound_margin >= terms::nodes * unit_roundoff &&
              bound_margin >= terms::node_heights * unit_roundoff &&
              bound_margin >= terms::axes * unit_roundoff);

/// The margin of bounds of spheres within a gap, times the gap.
constexpr double bound_gap_margin = 128 * unit_roundoff;
static_assert(bound_gap_margin >= terms::of_gap * unit_roundoff);
/// What distances of centres and gaps are multiplied with in clearance().
constexpr float far_centres = 1 + 0x1p-21f, near_gap = 1 - 0x1.8p-20f;
static_assert(double{far_centres} - 1 == terms::lifted * unit_roundoff &&
              1 - double{near_gap} == terms::shortened * unit_roundoff);

/// The margin that is added to every sphere's radius, times the body's extent.
constexpr double sphere_margin = terms::sphere_error * unit_roundoff;

// Supports of spheres have the margin of those of discs: spheres that the float test accepts are hardly farther apart.
static_assert(support_margin >=
              (terms::support_error + terms::sphere_error + terms::support_float) * unit_roundoff);

}  // namespace bch::detail::rounding
