// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bit>
#include <cstdint>

/// How far discs are enlarged so that a query in float never misses what the exact outlines hit: the proof.
/// tests/rounding_test.cpp measures every step and attacks the whole with exact arithmetic.
///
/// Notation. u = 2^-24, the unit roundoff of float: fl(x op y) = (x op y)(1 + e), |e| <= u. A shape's *reach* P is the largest
/// distance of its points from its origin. A disc's *tight* radius r is the largest distance of what it holds from its
/// centre, which is a float and exact. For shapes A and B at relative position d, S = P_A + P_B. a and b are a disc's
/// centre of each, D the exact distance between the two. First-order terms only: the products of two errors, and what
/// double loses (2^-53 = 2^-29 u), are below 2^-10 of them and are added at the end (higher).
///
/// The query (every kernel and the reference, same operations, same order; no contraction):
///
///     d      = float(position_B - position_A)                   the difference in double
///     (c, s) = (cA cB + sA sB, cA sB - sA cB)                   rotation of B relative to A
///     t      = (cA dx + sA dy, cA dy - sA dx)                   position of B in A's frame
///     p      = (t.x + (c x - s y), t.y + (s x + c y))           a disc centre of B in A's frame
///     hit   <=>  (p.x - a.x)^2 + (p.y - a.y)^2 <= (r_A + r_B)^2
///
/// I. What the geometry gives.
///
///     (centre)   |a| <= P_A, |b| <= P_B     a smallest disc's centre is in the convex hull of what it holds, the
///                                           hull in the disc of radius P about the origin, which is convex
///     (radius)   r <= P                     that disc holds it all, and r is the least that some disc has
///     (contact)  D <= r_A + r_B <= S        where two outlines meet: the point in common is in both discs; (radius)
///     (shift)    |d| <= |a| + D + |b| <= 2 S          triangle; (centre), (contact)
///
/// II. Errors against the same formula in exact arithmetic with the exact headings, as lengths of vectors. A rotation
/// (c x - s y, s x + c y) rounds four products and two sums: each part is off by at most u (|c x| + |s y|) + u |c x - s y| <=
/// 2 u |(c, s)| |(x, y)| (Cauchy), both together by 2 sqrt(2) u = 2.83 u of the product of lengths; an error e of (c, s)
/// adds |e| |(x, y)|, as complex numbers multiply.
///
///     (heading)  0.72 u                  each unit vector, to float: sqrt(2) u / 2 (1 + 2^-7), layout/heading.hpp
///     (turn)     4.3 u                   (c, s): two of (heading), 1.44 u, and the rounding of a rotation, 2.83 u
///     (arm)      7.1 u P_B               b turned: (turn) P_B, and the rounding, 2.83 u P_B; (centre)
///     (position) 4.6 u |d|               t: d to float u |d|, (heading) |d|, and the rounding, 2.83 u |d|
///     (sum)      u (|d| + P_B)           p = t + arm, a rounding of each part
///     (apart)    u D                     p - a, a rounding of each part
///     (square)   u D                     squares and their sum: 2 u of the square are u of its root
///     (radii)    1.5 u (r_A + r_B)       the sum u, its square u of the square
///
/// III. All of it together. By (shift), (contact) and P_B <= S the sides of the comparison are off by at most
///
///     7.1 u P_B + 4.6 u (2 S) + u (2 S + P_B) + u S + u S + 1.5 u S  <=  22.8 u S  <=  23 u S                (1)
///
/// No miss: two outlines that meet have tight discs with D <= r_A + r_B, exactly. Published radii add 23 u P
/// each, so by (1) the float test accepts. Two more sources belong to the shape and are added beside:
///
///     (halving)  2 * 0.71 u P            a segment that was halved: each midpoint is rounded
///     (grid)     1.5 grid steps          an outline on a grid: sqrt(1/2) by snapping, as much by rounding a crossing
///     (higher)   0.03 u P                2^-10 of all that
///
/// which makes 24.5 u P, published as 25.5 u P, rounded up. What that costs: where the float test accepts, D is at most
/// the tight radii and what was added, (25.5 + 2) u S with the rounding up, and 23 u S by (1), beside the grid, whose step
/// is at most 2^-22 P:
///
///     (price)    a false positive has a gap of at most 50.5 u S + 1.5 * 2^-22 S = 3.4e-6 S
///
/// IV. Nesting. A pruning disc (centre C, radius R) holds the cut discs below it with a slack n: |C - c| + r <= R - n. If
/// the float test accepts leaves, then by (1)
///
///     (leaves)   D <= r_A + r_B + 23 u S
///     (pruning)  D' <= D + |C_A - a| + |C_B - b| <= (R_A - n_A) + (R_B - n_B) + 23 u S
///
/// With D' <= 3 S, and R_A + R_B <= 6 S (else the test is far from its limit), the sum of II for that pair is at most
///
///     7.1 u S + 9.2 u S + 3 u S + 6 u S + 9 u S  <=  36 u S                                                  (2)
///
/// n = 59 u P, 23 and 36, would do: then the float test of every ancestor accepts, so pruning changes no answer. Where a
/// pruning disc meets a leaf of a much larger shape, n in P alone falls short of an error in S: so tests in which a pruning
/// disc takes part add nesting_slack S, 64 u S, to the sum of the radii besides.
///
/// V. Supports part two shapes when t.u > h_A + a h_B + b h_B' for a direction u of A, where h_B and h_B' are
/// B's supports on either side of -u and a, b >= 0 follow from the rotation. t and its product with u,
/// rounded, are off by 9.2 u S + 6 u |t|, with |t| <= 2 S where it matters; a and b by 59 u each (the
/// rotation's 4.3 u and what the sector's own rotation adds, 11.5 u together, through a quotient by sin 11.25),
/// times a support of at most 2 P; the sums by 6 u S:
///
///     21 u S + 236 u S + 6 u S  =  263 u S                                                                   (3)
///
/// Discs that the float test accepts are at most 23 u S apart, so supports enlarged by 286 u P each never part them.
///
/// VI. The ends of the range. (underflow) Radii are at least 25 u P >= 1e-12 m (P >= smallest_reach), so (r_A + r_B)^2 >=
/// 1e-24, while what a square loses below FLT_MIN, flushed to zero or not, is under 1e-37. A product in (turn), (arm) or
/// (position) that is flushed loses 1.2e-38, where u P is 6e-14 m or more. (overflow) |d| <= 2e9 sqrt(2) m (limits below),
/// squared 8e18.
namespace bch::rounding {

constexpr double unit_roundoff = 0x1p-24;

/// Added to every published radius, times the shape's reach: (1), halving, higher orders.
constexpr double query_margin = 25.5 * unit_roundoff;
/// Added to every pruning radius beyond what it holds, times the shape's reach.
constexpr double nesting_margin = 64 * unit_roundoff;
/// Added by queries to a sum of radii one of which is a pruning one, times the sum of the shapes' reaches.
constexpr float nesting_slack = 0x1p-18f;
/// Added to every support, times the shape's reach.
constexpr double support_margin = 320 * unit_roundoff;
/// Snapping moves a vertex by sqrt(1/2) grid steps, and rounding a crossing to the grid by as much
/// again: 1.42.
constexpr double outline_grid_steps = 1.5;

/// The documented domain; beyond it the library throws.
constexpr double smallest_reach = 1e-6;   // metres
constexpr double largest_reach = 1e6;     // metres
constexpr double largest_position = 1e9;  // metres
constexpr double largest_heading = 1e9;   // radians

/// The smallest float that is not below a finite value >= 0. Without a branch, which would be a coin toss.
inline float round_up(double value) {
  const float nearest = static_cast<float>(value);
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) +
                              std::uint32_t{static_cast<double>(nearest) < value});
}

}  // namespace bch::rounding
