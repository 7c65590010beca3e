// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/query.hpp>

namespace bch {

/// Tells how far the first agent of a pair has to move to be free of the second, which stays, and in which direction.
///
/// The depth of two agents A and B along a direction u is how far A has to move along
/// u until no disc of its cut overlaps one of B's and neither outline encloses anything of the other, there
/// or anywhere further along u.
///
///     s(u) = max over B's discs (b . u + r) - min over A's discs (a . u - r),    depth = max(0, s(u))
///
/// over the discs of the cuts. The depth has these properties:
///
/// - *Sufficient.* After A has moved by s(u) or more, a line across u separates A and B: their discs, the
///   outlines that these cover, and what the outlines enclose. The depth is rounded up so that collide() then answers
///   0 if A's new position is right to 1e-7 of the two shapes' reach (in doubles: up to
///   1e8 m or so from the origin). Where the agents are far apart, rounding the direction turns the line that separates
///   them: in float by centimetres at 1e6 m.
/// - *Continuous.* Where no point of an agent moves by more than m, by shifting or by turning, no a . u changes
///   by more than m, so neither does the depth. Where both agents move, it changes by no more than both moves together. The
///   smallest depth of several directions is continuous, too. (Rounding adds 1e-6 of the two shapes' reach and 4e-7 of the depth.)
/// - *Symmetric.* B has to move as far along -u as A along u: the same bits, with the direction negated.
/// - *The least continuous depth.* Let T be the largest t >= 0 at which a disc of A's cut still overlaps one of B's when
///   A has moved by t u, or 0. Every f >= T that is continuous in this sense, in A's position alone, is at
///   least s(u). Proof: let s(u) belong to two discs, and let w be how far they are apart across u. Start at q, which is
///   n behind A along u and w beside it. From there the two discs touch last at n + s(u). So f(A) >= f(q) -
///   |q - A| >= n + s(u) - sqrt(n^2 + w^2), for every n.
///
/// Bodies in slabs, or at different heights, have the largest s(u) of the parts that may meet, and 0 where no parts may.
///
/// Continuity has a price: the depth may be positive where nothing overlaps yet, because one agent may reach around the
/// other. Along a given direction no continuous depth can be zero there: if A touches B from behind, A still has to pass all of
/// B. So query only pairs that collide. Over all directions, the way to the nearest place without overlapping
/// discs lies between two bounds, and both are continuous. The lower one is the deepest overlap of two discs (clearance() with
/// Overlap::deepest). It is zero until they touch, and suits forces that grow from contact on. The upper one is this depth, and
/// suits corrections of positions that are applied at once.
struct Penetration {
  float depth;  ///< metres, not negative; 0: a line across the direction separates the two
  double x, y;  ///< the direction in which the first agent moves, in the world; a unit vector within 1e-9
  friend bool operator==(const Penetration&, const Penetration&) = default;
};

/// Measures the depth of each pair along a given direction, which may have any length and is returned as a unit vector.
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

/// Measures the least depth of each pair along `directions` evenly spread directions, the first of which is the x axis.
/// Call it for pairs that collide. Usual numbers k of directions are 16 to 32, and the time is proportional to k. Of equal depths,
/// the one of the first direction in the order 0, k / 2, 1, k / 2 + 1 ... counts, as seen from the agent with the lower index.
/// Everything else is as for penetration_along().
/// Errors:  also on a number of directions that is odd, which would not be symmetric, below 2 or above most_directions.
void penetration(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                 std::uint32_t directions, std::span<Penetration> out, const QueryOptions& options = {});

/// Limits the number of directions that penetration() takes.
constexpr std::uint32_t most_directions = 256;

}  // namespace bch
