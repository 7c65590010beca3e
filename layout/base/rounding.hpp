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
/// Notation. u = 2^-24, the unit roundoff of float: fl(x op y) = (x op y)(1 + e), |e| <= u. A shape's *extent* P is the
/// largest distance of its points from its origin. A disc's *tight* radius r is the largest distance of its node's
/// primitives from the disc's centre. The centre is taken as stored, in float, so it has no error. A *cut disc* is a
/// disc of the cut that a query compares: of a node at the level's depth, or of a leaf above it. For shapes A and B at
/// relative position d, S = P_A + P_B. a and b are a disc's centre of each, D the exact distance between the two.
/// First-order terms only: the products of two errors, and what double loses (2^-53 = 2^-29 u), are below 2^-10 of them
/// and are added at the end (higher).
///
/// Names in parentheses are those of the constants below, in namespace terms, in units of u. Every sum of this text is a
/// static_assert over them, so that a margin below what the text asks for does not compile. The other derivations of the
/// project stand next to their margins and end in static_asserts of the same kind.
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
///     (radius)   r <= P                     the disc of radius P contains it all, and no disc that does is smaller than r
///     (contact)  D <= r_A + r_B <= S        if two outlines meet in a point that both discs contain; (radius)
///     (shift)    |d| <= |a| + D + |b| <= 2 S          triangle; (centre), (contact)
///
/// II. Errors against the same formula in exact arithmetic with the exact headings, as lengths of vectors. A rotation
/// (c x - s y, s x + c y) rounds four products and two sums: each part is off by at most u (|c x| + |s y|) + u |c x - s y| <=
/// 2 u |(c, s)| |(x, y)| (Cauchy), both together by 2 sqrt(2) u of the product of lengths, (rotation); an error e of (c, s)
/// adds |e| |(x, y)|, as complex numbers multiply.
///
///     (rotation) 2.829 u |(x, y)|        the products and sums of a rotation, see above
///     (heading)  0.72 u                  each unit vector, to float: sqrt(2) u / 2 (1 + 2^-7), layout/base/heading.hpp
///     (turn)     4.3 u                   (c, s): two of (heading), and (rotation)
///     (arm)      7.1 u |b|               b turned: two of (heading), and two of (rotation); |b| <= P_B by (centre)
///     (position) 4.6 u |d|               t: d to float u |d|, (heading) |d|, and (rotation) |d|
///     (sum)      u (|d| + |b|)           p = t + arm, a rounding of each part
///     (apart)    u D                     p - a, a rounding of each part
///     (square)   u D                     squares and their sum: 2 u of the square are u of its root
///     (radii)    1.5 u (r_A + r_B)       the sum u, its square u of the square
///
/// III. The sum. By (shift), (contact) and P_B <= S the sides of the comparison are off by at most
///
///     7.1 u P_B + 4.6 u (2 S) + u (2 S + P_B) + u S + u S + 1.5 u S  <=  22.8 u S  <=  23 u S                (1)
///
/// and that is (query_error). If both discs touch, and each is the smallest around its content, the bound is smaller.
/// The content touches every closed semicircle of its smallest disc, also the one that faces away from the origin. A
/// point there is at least sqrt(|a|^2 + r^2) from the origin, so |a|^2 + r_A^2 <= P_A^2. With |d| <= |a| + |b| + D and
/// D <= r_A + r_B the same terms are
///
///     13.7 u |b| + 5.6 u |a| + 9.1 u (r_A + r_B)  <=  16.5 u P_B + 10.7 u P_A  <=  16.5 u S                  (1')
///
/// by Cauchy: (contact_error). No miss: where two outlines meet, a cut disc of either contains the common point, and so does
/// every ancestor of that disc, up to the root. So for every pair of a node on one path to the root and a node on the other path,
/// the tight discs have D <= r_A + r_B, exactly. Published radii add (contact_error) P each, so the float test accepts all these
/// pairs, which is the definition of a hit: see <bch/query.hpp>. A traversal may skip everything below a pair that the float test
/// rejects, because by that definition no pair below is a hit. Further errors belong to the shape and are added:
///
///     (halving)  8.9 u P                 a segment that was halved: each midpoint is rounded to float
///     (grid)     1.5 grid steps          an outline on a grid: sqrt(1/2) by snapping, as much by rounding a crossing
///     (higher)   0.03 u P                2^-10 of all these
///
/// which makes 25.43 u P, published as query_margin, 25.5 u P, and rounded up.
///
/// Halving: the error of a midpoint is half the sum of the errors of its ends, plus u P. So after k halvings it is off
/// by (2 k + 1) / 3 u P: at most 8.4 u P after 12, which make 4096 pieces of one segment. After more halvings parity
/// helps: midpoints that were rounded have an even last bit, so that the next one is exact. Coordinates from 2^E to
/// 2^(E + 1) are then off by (4 k + 6) / 9 u 2^E at most (every difference of up to 2^15 units in the last place was
/// tried; tests/kernel/rounding_test.cpp repeats a part of that). And k halvings are possible in a coordinate only if
/// the ends of the segment differ in it by at least 2^k units in the last place, which are 2^(E - 23) each. The larger
/// end, and with it P, is then at least 2^E + 2^k 2^(E - 23) = (1 + 2^(k - 23)) 2^E. So the error is at most 8.6 u P
/// after any number of halvings.
///
/// The cost of the margin: if the float test accepts, D is at most the sum of the tight radii and of four terms: the
/// margins, 25.5 u S; their rounding up, 2 u S; the error of the test, 23 u S by (1); and 1.5 grid steps, each step at
/// most 2^-22 P. So
///
///     (price)    a false positive has a gap of at most 50.5 u S + 1.5 * 2^-22 S = 3.4e-6 S
///
/// IV. Supports: how far a shape extends from its origin along 32 fixed directions (layout/culling/supports.hpp). They
/// separate two shapes if t.v > h_A + alpha h_B + beta h_B' for one of A's directions v. h_B and h_B' are B's supports
/// along its two directions next to -v, and the weights alpha, beta >= 0 follow from the rotation.
///
///     (support_place)    21.2 u S        t and its product with v, rounded: 9.2 u S + 6 u |t|, with |t| <= 2 S where it
///                                        matters
///     (support_weight)   59 u            alpha and beta each: (turn), and the rotation from one of B's directions to -v,
///                                        11.5 u together, divided by sin 11.25 degrees; times a support of at most 2 P
///     (support_sums)     6 u S           the sums
///
/// All together
///
///     21.2 u S + 4 * 59 u S + 6 u S  <=  264 u S                                                             (2)
///
/// Discs that the float test accepts are at most 23 u S apart, so supports enlarged by 287 u P each, and by the 5.2 u P
/// of their own rounding (support_float, layout/culling/supports.cpp), never separate them: support_margin. Supports of
/// outlines never separate segments that meet, which are at most (segment_price) apart. Only this proof needs all of
/// support_margin. Tests pass with less, and fail if the margin is subtracted.
///
/// V. Exact leaves: segments. Two segments are compared in double (kernel/simd/segment_test.hpp), B's ends placed by
/// the floats (c, s) and t. Rounding in double is 2^-29 u, part of (higher). Where outlines meet in a point, it is at
/// most P_A from A's origin and P_B from B's, so |d| <= S. The placed ends are off by
///
///     (segment_place)    8.9 u S         (turn) of |b|, and (position) of |d|
///
/// Segments meet where an end of one is within
///
///     (segment_margin)   13 u P          of either shape, and 1.5 of its grid steps
///
/// of the other, or where both ends of each lie on different sides of the other's line, at least 0.7 (sure_fraction) of
/// that margin away from it. No miss: outlines that meet, snapped and placed, are at most (segment_place) and 1.5 of
/// each grid step apart. If the placed segments are disjoint, an end of one is at most that far from the other. If they
/// cross without the test of sides being met, an end is within sqrt(2) 0.7 of the margin of the other's line. (The test
/// multiplies the margin by |x| + |y| of a segment (x, y) in place of its length; that sum is up to sqrt(2) times the
/// length.) Then some end is at most that far from the other segment: this end or, if it lies beyond an end of the
/// other segment, that other end, which is nearer to the crossing. A crossing by (sure_fraction) is a crossing of the
/// outlines themselves. They could only be apart if, without the errors, an end were on the other side of the other
/// segment, and no end is off by so much:
///
///     sure_fraction * segment_margin > segment_place
///
/// The price, by the same steps as above: segments that meet are at most the margin and (segment_place) apart,
///
///     (segment_price)    (13 + 8.9) u S + 1.5 * 2^-22 S = 1.7e-6 S
///
/// VI. The ends of the range. (underflow) Radii are at least 25 u P >= 1e-12 m (P >= smallest_extent), so (r_A + r_B)^2 >=
/// 1e-24, while what a square loses below FLT_MIN, flushed to zero or not, is under 1e-37. A product in (turn), (arm) or
/// (position) that is flushed loses 1.2e-38, where u P is 6e-14 m or more. (overflow) |d| <= 2e9 sqrt(2) m (limits below),
/// squared 8e18.
///
/// VII. Heights. Planes cut outlines between heights. A corner in a plane is lower + (upper - lower) t, where t
/// = (h - z) / (z' - z), all in double: the two differences and the quotient leave 3 * 2^-53 of a t that is at most 1, however
/// level the edge is, and the rest 3 roundings of lengths up to 2 P. That is below 2^-49 P, and so below 2^-25 of a grid step, which is at
/// least 2^-24 P of the whole mesh. The corner is rounded to the grid as a vertex is; the sum stays below 1.5 grid steps (grid).
/// Heights of agents at different grounds are compared in double with a slack of 1e-9 m and 2^-50 of the difference, compared with which the
/// rounding of two sums of lengths up to 1e6 m is nothing.
///
/// VIII. Nodes that enclose the discs below them, as in bodies made of discs, overlap wherever the discs do, if they
/// enclose them with a margin, (conservative_margin). The float test accepts discs with D <= r_A + r_B + (query_error) S. With
/// R >= |C - c| + r + margin, a node of A and a disc of B are at most R_A + r_B - margin_A + (query_error) S apart, and
/// the test accepts what is at most R_A + r_B - (query_error) S apart. So the margin of either shape has to be 2
/// (query_error) S; the margins of two nodes add up. Margins are fractions of their own shape's extent: they suffice if
/// S is at most (conservative_ratio) times the lesser extent.
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
/// A crossing of two segments is sure if all ends are beyond the other segment's line by this fraction of the margin.
constexpr double sure_fraction = 0.7;
static_assert(terms::root_2 * sure_fraction < 1);
static_assert(sure_fraction * segment_margin >= (terms::segment_place + terms::higher) * unit_roundoff);

/// The margin with which nodes enclose their discs, times the shape's extent. It suffices for pairs whose extents sum
/// to at most conservative_ratio times the lesser one: twice (query_error) of both, and the rounding of the check itself.
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
