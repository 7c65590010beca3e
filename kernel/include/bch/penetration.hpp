// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/query.hpp>

namespace bch {

/// A penetration: how far the first agent of a pair has to move to be free of the second, which stays, and in which direction.
///
/// The depth of two agents A and B along a direction u is how far A has to move along
/// u until no disc of its cut overlaps one of B's and neither outline encloses anything of the other, there
/// or anywhere further along u.
///
///     s(u) = max over B's discs (b . u + r) - min over A's discs (a . u - r),    depth = max(0, s(u))
///
/// over the discs of the cuts. What this promises:
///
/// - *Enough.* A that has moved by s(u) or more lies behind a line across u, and B before it: discs, the
///   outlines that they cover, and what those enclose. The depth is rounded up so that collide() then answers
///   0, in either semantics, if A's new position is right to 1e-7 of the two shapes' reach (in doubles: up to
///   1e8 m or so from the origin). Far apart, rounding the direction turns the line that separates them: in
///   float by centimetres at 1e6 m.
/// - *Continuous.* Where no point of an agent moves by more than m, by shifting or by turning, no a . u changes
///   by more, so the depth does not either; and no more than both together where both move. The smallest of
///   several directions inherits that. (Beside rounding: 1e-6 of the two shapes' reach, 4e-7 of the depth.)
/// - *Symmetric.* B has to move as far along -u as A along u: the same bits, the direction negated.
/// - *The least continuous depth.* Let T be the largest t >= 0 at which a disc of A's cut still overlaps one of B's when
///   A has moved by t u, or 0. Every f >= T that is continuous in this sense, in A's position alone, is at
///   least s(u): let s(u) belong to two discs, w be how far they are apart across u, and start at q, which is
///   n behind A along u and w beside it. From there the two discs touch last at n + s(u). So f(A) >= f(q) -
///   |q - A| >= n + s(u) - sqrt(n^2 + w^2), for every n.
///
/// Bodies in slabs, or at different heights, have the largest s(u) of the parts that may meet, and 0 where none may.
///
/// The price of continuity: the depth may be positive where nothing overlaps yet, because one agent may reach around the
/// other. Along a given direction no continuous depth can be zero there: if A touches B from behind, it has all of
/// B before it. So ask for pairs that collide. Over all directions, the way to the nearest place without overlapping
/// discs lies between two bounds, both continuous: the deepest overlap of two discs (clearance() with Overlap::deepest),
/// which is zero until they touch, for forces that grow from contact on; and this depth, for corrections of positions
/// that are done at once.
struct Penetration {
  float depth;  ///< metres, not negative; 0: a line across the direction separates the two
  double x, y;  ///< where the first agent moves, in the world; a unit vector within 1e-9
  friend bool operator==(const Penetration&, const Penetration&) = default;
};

/// Measures the depth of each pair along a direction of its own, of any length; the answer has it as a unit vector.
/// The answer is the same bits on every processor, for any number of threads and any split of the batch. Only the
/// difference of positions counts.
/// Options: implementation.
/// Sizes:   as many directions and answers as pairs; the set need not have outlines. An agent may be paired with
///          itself: then it has to move by its own width.
/// Errors:  throws std::invalid_argument, before out is touched, like collide(), and on a direction that is zero or not
///          finite, naming the pair.
/// Memory:  allocates nothing.
/// Threads: runs in the caller's TBB arena.
void penetration_along(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                       std::span<const Vec2> directions, std::span<Penetration> out,
                       const QueryOptions& options = {});

/// Measures the least depth of each pair along `directions` evenly spread directions, the first of which is the x axis. In a tie it is, for the agent of the lower index, the first one of 0, k / 2, 1, k / 2 + 1 ...
/// Ask for pairs that collide; 16 to 32 directions are usual, and the time is in proportion to them. All else is as for
/// penetration_along().
/// Errors:  also on a number of directions that is odd, which would not be symmetric, below 2 or above most_directions.
void penetration(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                 std::uint32_t directions, std::span<Penetration> out, const QueryOptions& options = {});

/// The largest number of directions that penetration() takes.
constexpr std::uint32_t most_directions = 256;

}  // namespace bch
