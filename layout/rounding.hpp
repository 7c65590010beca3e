// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bit>
#include <cstdint>

/// How far discs are enlarged so that a query in float never misses what the exact outlines hit.
///
/// Notation. u = 2^-24, the unit roundoff of float. A shape's *reach* P is the largest distance of its points
/// from its origin, so every disc centre c and every tight radius r of it has |c| <= P and r <= P. For shapes
/// A and B at relative position d, S = P_A + P_B. First-order terms only; 2^-10 relative is added at the end
/// for all higher ones.
///
/// The query (every kernel and the reference, same operations, same order; no contraction):
///
///     d      = float(position_B - position_A)                   the difference in double
///     (c, s) = (cA cB + sA sB, cA sB - sA cB)                   rotation of B relative to A
///     t      = (cA dx + sA dy, cA dy - sA dx)                   position of B in A's frame
///     p      = (t.x + (c x - s y), t.y + (s x + c y))           a disc centre of B in A's frame
///     hit   <=>  (p.x - a.x)^2 + (p.y - a.y)^2 <= (r_A + r_B)^2
///
/// Errors against the same formula in exact arithmetic with the exact headings, as lengths (norms):
///
///     heading unit vectors, to float          0.71 u each            sqrt(2) u/2: components are at most 1
///     (c, s): two of those and 2 u a part     4.3 u                  1.42 u + 2 sqrt(2) u
///     rotating a centre of B by it            7.1 u P_B              4.3 u + 2 sqrt(2) u
///     d to float, and t                       4.6 u |d|              u + 0.71 u + 2 sqrt(2) u
///     the sum p                               u (|d| + P_B)
///     the difference p - a                    u D                    D = distance of the centres
///     squares and their sum                   u D                    2 u of the square
///     r_A + r_B and its square                1.5 u (r_A + r_B)
///
/// At a hit D <= r_A + r_B <= S, hence |d| <= D + |a| + |b| <= 2 S, and all of it together stays below
///
///     7.1 u P_B + 9.2 u S + u (2 S + P_B) + 2 u S + 1.5 u S  <=  23 u S                (1)
///
/// No miss: two outlines that meet have tight discs with D <= r_A + r_B, exactly. Published radii add 23 u P
/// each, so by (1) the float test accepts. Two more sources belong to the shape and are added beside: a
/// segment that was halved is off by 2 * 0.71 u P (each midpoint is rounded), and an outline on a grid is off
/// by `outline_grid_steps` of its step.
///
/// Nesting: a pruning disc (centre C, radius R) holds the cut discs below it. If the float test accepts
/// leaves, then D <= r_A + r_B + 23 u S by (1), so the pruning discs' centres have D' <= (R_A - n_A) + (R_B -
/// n_B) + 23 u S, where n is the slack in R. With D' <= 3 S, and R_A + R_B <= 6 S (else the test is far from
/// its limit), the same sum for that pair is at most 7.1 + 9.2 + 4 + 6 + 9 = 36 u S. n = 59 u P would do:
/// then the float test of every ancestor accepts, so pruning changes no answer. Where a pruning disc meets a leaf of a
/// much larger shape, n in P alone falls short of an error in S: so tests in which a pruning disc takes part add
/// nesting_slack S to the sum of the radii besides.
///
/// Supports part two shapes when t.u > h_A + a h_B + b h_B' for a direction u of A, where h_B and h_B' are
/// B's supports on either side of -u and a, b >= 0 follow from the rotation. t and its product with u,
/// rounded, are off by 9.2 u S + 6 u |t|, with |t| <= 2 S where it matters; a and b by 59 u each (the
/// rotation's 4.3 u and what the sector's own rotation adds, 11.5 u together, through a quotient by sin 11.25),
/// times a support of at most 2 P; the sums by 6 u S. That is below 21 + 236 + 6 = 263 u S. Discs that the float
/// test accepts are at most 23 u S apart, so supports enlarged by 286 u P each never part them.
///
/// Underflow: radii are at least 26 u P >= 1e-12 m (P >= smallest_reach), so (r_A + r_B)^2 >= 1e-24, while
/// what a square loses below FLT_MIN, flushed to zero or not, is under 1e-37. Overflow: |d| <= 2e9 m (limits
/// below), squared 4e18.
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
