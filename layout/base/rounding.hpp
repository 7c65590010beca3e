// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "layout/base/plain_arithmetic.hpp"

/// Derives how much discs must be enlarged, so that a query in float never misses a hit of the exact outlines.
/// tests/kernel/rounding_test.cpp measures every step and tests the whole against exact arithmetic.
///
/// Notation. u = 2^-24, the unit roundoff of float: fl(x op y) = (x op y)(1 + e), |e| <= u. A shape's *extent* P is
/// the largest distance of its points from its origin. A disc's *tight* radius r is the largest distance of its node's
/// primitives from the disc's centre. The centre is taken as stored, in float, so it has no error. A *cut disc* is a
/// disc of the cut that a query compares: of a node at the level's depth, or of a leaf above it. For shapes A and B at
/// relative position d, S = P_A + P_B. a and b are a disc's centre of each, D the exact distance between the two.
/// First-order terms only: the products of two errors, and what double loses (2^-53 = 2^-29 u), are below 2^-10 of
/// them and are added at the end (higher).
///
/// Names in parentheses are those of the constants below, in namespace terms, in units of u. Every sum of this text is
/// a static_assert over them, so that a margin below what the text asks for does not compile. The other derivations of
/// the project stand next to their margins and end in static_asserts of the same kind.
///
/// The query (every kernel and the reference, same operations, same order; no contraction):
///
///     d      = float(position_B - position_A)                   the difference in double
///     (c, s) = (cA cB + sA sB, cA sB - sA cB)                   rotation of B relative to A
///     t      = (cA dx + sA dy, cA dy - sA dx)                   position of B in A's frame
///     p      = (t.x + (c x - s y), t.y + (s x + c y))           a disc centre of B in A's frame
///     hit   <=>  (p.x - a.x)^2 + (p.y - a.y)^2 <= (r_A + r_B)^2
///
/// I. Bounds by geometry.
///
///     (centre)   |a| <= P_A, |b| <= P_B     a smallest disc's centre is in the convex hull of its content, and the
///                                           hull is in the disc of radius P about the origin, which is convex
///     (radius)   r <= P                     the disc of radius P contains it all, and no such disc is smaller than r
///     (contact)  D <= r_A + r_B <= S        if two outlines meet in a point that both discs contain; (radius)
///     (shift)    |d| <= |a| + D + |b| <= 2 S          triangle; (centre), (contact)
///
/// II. Errors of the query, against the same formulas in exact arithmetic with the exact headings. Each is the length
/// of the vector by which a result is off.
///
///     (rotation) 2.829 u |(x, y)|        (c x - s y, s x + c y) with exact factors: see below
///     (heading)  0.72 u                  each unit vector, to float: sqrt(2) u / 2 (1 + 2^-7), layout/base/heading.hpp
///     (turn)     4.3 u                   (c, s): two of (heading), and (rotation)
///     (arm)      7.1 u |b|               b turned: two of (heading), and two of (rotation); |b| <= P_B by (centre)
///     (position) 4.6 u |d|               t: d to float u |d|, (heading) |d|, and (rotation) |d|
///     (sum)      u (|d| + |b|)           p = t + arm, a rounding of each part
///     (apart)    u D                     p - a, a rounding of each part
///     (square)   u D                     squares and their sum: 2 u of the square are u of its root
///     (radii)    1.5 u (r_A + r_B)       the sum u, its square u of the square
///
/// (rotation): The two products of one part are off by at most u (|c x| + |s y|), and their sum by u |c x - s y|. By
/// Cauchy's inequality, each part is off by at most 2 u |(c, s)| |(x, y)|, so both together by 2 sqrt(2) u |(x, y)|.
/// If (c, s) is off by e, the result is off by |e| |(x, y)| more, because a rotation multiplies complex numbers.
///
/// III. The sum. (shift), (contact) and P_B <= S bound the lengths in II, in this order: (arm), (position), (sum),
/// (apart), (square), (radii). So the two sides of the comparison are off by at most
///
///     7.1 u P_B + 4.6 u (2 S) + u (2 S + P_B) + u S + u S + 1.5 u S  <=  22.8 u S  <=  23 u S                (1)
///
/// which is (query_error). The bound is smaller if the outlines meet in a point of both discs, and each disc is the
/// smallest around its content. The content then touches every closed semicircle of its disc, also the one that faces
/// away from the origin. A point of that semicircle is at least sqrt(|a|^2 + r^2) from the origin. So
/// |a|^2 + r_A^2 <= P_A^2, and the same holds for B. With |d| <= |a| + |b| + D and D <= r_A + r_B, the same terms are
///
///     13.7 u |b| + 5.6 u |a| + 9.1 u (r_A + r_B)  <=  16.5 u P_B + 10.7 u P_A  <=  16.5 u S                  (1')
///
/// by Cauchy's inequality. That is (contact_error).
///
/// No miss. Let two outlines meet in a point. In each tree, a cut disc and all its ancestors contain that point. So
/// each of these nodes of A and each of these nodes of B have exact tight discs with D <= r_A + r_B. Published radii
/// add (contact_error) P each, so the float test accepts all these pairs. That is the definition of a hit
/// (<bch/query.hpp>). A traversal may skip everything below a pair that the float test rejects, because by that
/// definition no pair below is a hit.
///
/// Further errors belong to one shape and are added to its radii:
///
///     (halving)  8.9 u P                 a segment that was halved: each midpoint is rounded to float
///     (grid)     1.5 grid steps          an outline on a grid: sqrt(1/2) by snapping, as much by rounding a crossing
///     (higher)   0.03 u P                2^-10 of all these
///
/// Without the grid, that makes 25.43 u P. query_margin is 25.5 u P; the sum of radius and margins is rounded up.
///
/// Halving. Let e_k be the error of the midpoint after k halvings of a segment with exact ends. One end of the halved
/// piece is the previous midpoint; the other end is older. The error of the new midpoint is half the sum of the errors
/// of both ends, plus u P:
///
///     e_k <= (e_(k-1) + e_(k-2)) / 2 + u P,  hence  e_k <= (2 k + 1) / 3 u P
///
/// For k <= 12, which makes 4096 pieces of one segment, e_k is at most 8.4 u P. For larger k, consider one coordinate
/// between 2^E and 2^(E + 1), in units in the last place, which are 2^(E - 23) each:
///
///   - A midpoint is rounded only if one end is odd and the other is even. The rounded midpoint is even. So its own
///     midpoint with the even end is exact.
///   - The error is then at most (4 k + 6) / 9 u 2^E. This was tried for every difference of up to 2^15 units
///     (tests/kernel/rounding_test.cpp repeats a part of that).
///   - k halvings are possible only if the ends differ by at least 2^k units. So the larger end, and P with it, is at
///     least 2^E + 2^k 2^(E - 23) = (1 + 2^(k - 23)) 2^E.
///   - The quotient of both bounds is at most 8.6 u P, for any k.
///
/// The cost of the margin. If the float test accepts, D is at most the sum of the tight radii and of four terms: the
/// margins, 25.5 u S; their rounding up, 2 u S; the error of the test, 23 u S by (1); and 1.5 grid steps of each
/// shape, where a step is at most 2^-22 P. So
///
///     (price)    a false positive has a gap of at most 50.5 u S + 1.5 * 2^-22 S = 3.4e-6 S
///
/// IV. Supports. A support is how far a shape extends from its origin along one of 32 fixed directions
/// (layout/culling/supports.hpp). Supports separate two shapes if, for one of A's directions v,
///
///     t.v > h_A + alpha h_B + beta h_B'
///
/// h_A is A's support along v. h_B and h_B' are B's supports along its two directions next to -v. The weights alpha
/// and beta, both >= 0, follow from the rotation. Only pairs whose outlines meet, or whose discs the float test
/// accepts, must not be separated; they have |d| <= 2 S by (shift), and so |t| <= 2 S.
///
///     (support_place)    21.2 u S        t.v: (position) of t, 4.6 u |d| <= 9.2 u S; rounding v, the two products and
///                                        their sum, 6 u |t| <= 12 u S
///     (support_weight)   59 u            alpha and beta each: (turn), and the rotation from one of B's directions to
///                                        -v, 11.5 u together, divided by sin 11.25 degrees
///     (support_sums)     6 u S           the sums
///
/// Each weight multiplies a support of at most 2 P_B, so the two weights make 2 * 59 u * 2 S. All together
///
///     21.2 u S + 4 * 59 u S + 6 u S  <=  264 u S                                                             (2)
///
/// Discs that the float test accepts are at most 23 u S apart, by (1). So supports never separate such discs if they
/// are enlarged by 264 u P + 23 u P, and by 5.2 u P for their own rounding (support_float,
/// layout/culling/supports.cpp). support_margin is more than this sum. It also covers exact leaves: supports of
/// outlines never separate segments that meet by the definition in V, whose distance is at most (segment_price) S. The
/// whole of support_margin is needed only for this proof: tests pass with a smaller margin, and fail if the margin is
/// subtracted instead of added.
///
/// V. Exact leaves: segments. Two segments are compared in double (kernel/simd/segment_test.hpp). B's ends are placed
/// by the floats (c, s) and t; the rounding in double is 2^-29 u, part of (higher). A common point of two outlines is
/// at most P_A from A's origin and at most P_B from B's origin, so |d| <= S. The placed ends are off by
///
///     (segment_place)    8.9 u S         (turn) of |b|, and (position) of |d|
///
/// Let the margin m of two shapes be (segment_margin) = 13 u times S, plus 1.5 grid steps of A and 1.5 of B. Two
/// segments *meet* if one of two things holds:
///
///   - An end of one segment is within m of the other segment.
///   - Each segment has its two ends on different sides of the other one's line, both at least 0.7 m (sure_fraction)
///     away from this line. (The test multiplies m by |x| + |y| of a segment (x, y) in place of its length. That sum
///     is up to sqrt(2) times the length. So an end that fails the test is less than sqrt(2) 0.7 m, and so less than
///     m, away.)
///
/// No miss. Segments of outlines that meet are, after snapping and placing, at most (segment_place) and 1.5 of each
/// grid step apart, which is less than m. So the segments meet in each of three cases:
///
///   - They are disjoint. Two disjoint segments are nearest at an end of one of them, and this end is within m.
///   - They cross and pass the test of sides.
///   - They cross, but an end E of one is less than m from the other segment's line. If the point of this line nearest
///     to E belongs to the other segment, E is within m of that segment. If not, an end F of the other segment lies on
///     the line between the crossing and this nearest point. Then F is nearer to E's segment than E is to the line, so
///     F is within m.
///
/// A crossing that passes the test of sides is *sure*: the outlines as stored cross, too. Otherwise the errors of
/// placing would have moved an end across the other segment's line, but no end is off by so much:
///
///     sure_fraction * segment_margin > segment_place
///
/// The price: segments that meet are at most m plus (segment_place) apart. With grid steps of at most 2^-22 P that is
///
///     (segment_price)    (13 + 8.9) u S + 1.5 * 2^-22 S = 1.7e-6 S
///
/// VI. The ends of the range.
///
///     (underflow)  Radii are at least 25 u P >= 1e-12 m, because P >= smallest_extent. So (r_A + r_B)^2 >= 1e-24. A
///                  square below FLT_MIN loses less than 1e-37, whether it is flushed to zero or not. A product in
///                  (turn), (arm) or (position) that is flushed loses 1.2e-38, where u P is 6e-14 m or more.
///     (overflow)   |d| <= 2e9 sqrt(2) m by the limits below, and its square is at most 8e18.
///
/// VII. Heights. Planes cut outlines between heights. Let an edge lead from the corner `lower` at height z to `upper`
/// at height z', and let h be the height of the plane. The new corner is lower + (upper - lower) w with w = (h - z) /
/// (z' - z) <= 1, all in double. The two differences and the quotient are off by 3 * 2^-53 w, however level the edge
/// is. The rest is 3 roundings of lengths up to 2 P. All this is below 2^-49 P, and so below 2^-25 of a grid step,
/// which is at least 2^-24 P of the whole mesh. The corner is rounded to the grid as a vertex is; the sum stays below
/// 1.5 grid steps (grid). Heights of agents at different grounds are compared in double, with a slack of 1e-9 m plus
/// 2^-50 of the difference. The rounding of two sums of lengths up to 1e6 m is much smaller.
///
/// VIII. Nodes that enclose the discs below them, as in bodies made of discs. Such nodes overlap wherever the discs
/// below them do, if they enclose the discs with a margin, (conservative_margin). Let q = (query_error). Let a node of
/// A have the centre C and the radius R_A, and enclose a disc of A with the centre c and the radius r_A: R_A >= |C -
/// c| + r_A + margin_A.
///
///   - The float test accepts this disc and a disc of B only if they have D <= r_A + r_B + q S.
///   - Then the node's centre is at most |C - c| + D <= R_A + r_B - margin_A + q S from the centre of the disc of B.
///   - The float test surely accepts the node and the disc of B at distances of at most R_A + r_B - q S.
///
/// So a margin of 2 q S in A suffices for a node of A and a disc of B, and one of 2 q S in B for the reverse. A node
/// of A and a node of B have both margins, which is more than enough. Margins are stored as fractions of their own
/// shape's extent, so they suffice if S is at most (conservative_ratio) times the lesser extent.
namespace bch::detail::rounding {

constexpr double unit_roundoff = 0x1p-24;

/// Holds the terms of the derivation above, in units of unit_roundoff.
namespace terms {

constexpr double root_2 = 1.41421357;  // rounded up
constexpr double rotation = 2.829;
constexpr double heading = 0.72;
constexpr double turn = 4.3;
constexpr double arm = 7.1;
constexpr double position = 4.6;
constexpr double sum = 1, apart = 1, square = 1, radii = 1.5;
static_assert(rotation >= 2 * root_2);
static_assert(heading >= root_2 / 2 * (1 + 0x1p-7));
static_assert(turn >= 2 * heading + rotation);
static_assert(arm >= 2 * heading + 2 * rotation);
static_assert(position >= 1 + heading + rotation);

constexpr double query_error = 23;
static_assert(query_error >= arm + 2 * position + (2 + 1) * sum + apart + square + radii, "(1)");

/// Returns whether sqrt(x^2 + y^2) <= limit.
constexpr bool length_within(double x, double y, double limit) {
  return x * x + y * y <= limit * limit;
}
constexpr double contact_error = 16.5;
constexpr double by_radii = position + sum + apart + square + radii;  // D <= r_A + r_B
static_assert(length_within(arm + position + 2 * sum, by_radii, contact_error), "(1'), of B");
static_assert(length_within(position + sum, by_radii, contact_error), "(1'), of A");

/// Returns a bound for the error of the largest coordinate after k halvings: by induction, and by trying.
constexpr double halved(int k) {
  return (2 * k + 1) / 3.0;
}
constexpr double halved_often(int k) {
  return (4 * k + 6) / 9.0 / (1 + 1.0 / (1 << (23 - k)));
}
constexpr double halving = 8.9;
static_assert(halving >= halved(12));
static_assert(halving >= halved_often(18) && halving >= halved_often(19) && halving >= halved_often(20));
constexpr double higher = 0.03;
static_assert(higher >= 0x1p-10 * (query_error + 1));

constexpr double segment_place = 8.9;
static_assert(segment_place >= turn + position);

constexpr double support_place = 21.2;
constexpr double support_weight = 59;
constexpr double support_sums = 6;
constexpr double support_error = 264;
constexpr double support_float = 5.2;
static_assert(support_place >= 2 * position + 6 * 2);
static_assert(support_weight >= 11.5 * 5.1259);  // 1 / sin 11.25 degrees
static_assert(support_error >= support_place + 2 * 2 * support_weight + support_sums, "(2)");

}  // namespace terms

/// The margin added to every published radius, times the shape's extent: (1'), (halving) and (higher).
constexpr double query_margin = 25.5 * unit_roundoff;
static_assert(query_margin >= (terms::contact_error + terms::halving + terms::higher) * unit_roundoff);

/// The margin added to every support, times the shape's extent.
constexpr double support_margin = 320 * unit_roundoff;
static_assert(support_margin >=
              (terms::support_error + terms::query_error + terms::support_float) * unit_roundoff);

/// The distance within which two segments meet: this times the sum of the shapes' extents, plus the grid steps of
/// both.
constexpr double segment_margin = 13 * unit_roundoff;
static_assert(segment_margin >= (terms::segment_place + terms::higher) * unit_roundoff);
/// A crossing of two segments is sure if each segment has its ends on different sides of the other one's line, all at
/// least this fraction of the margin away from it.
constexpr double sure_fraction = 0.7;
static_assert(terms::root_2 * sure_fraction < 1);
static_assert(sure_fraction * segment_margin >= (terms::segment_place + terms::higher) * unit_roundoff);

/// The margin with which nodes enclose their discs, times the shape's extent. It suffices for pairs whose extents sum
/// to at most conservative_ratio times the lesser one: twice (query_error) of both, and the rounding of the check
/// itself.
constexpr double conservative_ratio = 3;
constexpr double conservative_margin = 47 * conservative_ratio * unit_roundoff;
static_assert(conservative_margin >=
              conservative_ratio * 2 * (terms::query_error + 8 * terms::higher) * unit_roundoff);

/// The error of an outline in grid steps: snapping moves a vertex by up to sqrt(1/2) steps, and rounding a crossing
/// to the grid by as much again.
constexpr double outline_grid_steps = 1.5;
static_assert(outline_grid_steps >= 2 * (terms::root_2 / 2));

/// The largest gap of a false positive, times the sum of the shapes' extents: (price).
constexpr double price = 3.4e-6;
static_assert(price >=
              query_margin + (2 + terms::query_error) * unit_roundoff + outline_grid_steps * 0x1p-22);

/// The largest gap of a false positive with exact leaves, times the sum of the shapes' extents: (segment_price).
constexpr double segment_price = 1.7e-6;
static_assert(segment_price >=
              segment_margin + terms::segment_place * unit_roundoff + outline_grid_steps * 0x1p-22);

static_assert(support_margin >=
              segment_price + (terms::support_error + terms::support_float) * unit_roundoff);

/// The documented domain; the library throws beyond it.
constexpr double smallest_extent = 1e-6;  // metres
constexpr double largest_extent = 1e6;    // metres
constexpr double largest_position = 1e9;  // metres
constexpr double largest_heading = 1e9;   // radians

/// Returns the smallest float that is not below a finite value >= 0. It has no branch, because a branch could not be
/// predicted.
inline float round_up(double value) {
  const float nearest = static_cast<float>(value);
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) +
                              std::uint32_t{static_cast<double>(nearest) < value});
}

/// Returns the largest float that is not above a value.
inline float round_down(double value) {
  const float nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value
             ? std::nextafter(nearest, -std::numeric_limits<float>::infinity())
             : nearest;
}

}  // namespace bch::detail::rounding
