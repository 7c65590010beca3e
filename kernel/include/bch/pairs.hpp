// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/body_set.hpp>
#include <bch/query.hpp>

namespace bch {

/// Tests whether the two agents of each pair collide at their levels, touching included, and writes 1 for a hit and 0 otherwise.
///
/// A collision is never missed: agents whose outlines meet collide at every level. Agents that do not collide at one level do
/// not collide at a deeper one either. The outlines of a false positive are apart by at most the two discs' diameters
/// plus 4 um per metre of the two shapes' reaches; between exact leaves, by at most 1.7 um per metre. The answer is the
/// same bits on every processor, for any number of threads, any split of the batch and either order within a pair. Only
/// the difference of positions counts, so answers far from the origin are the same as at the origin.
///
/// Agents with a z (Agents::z) collide only if their ranges of height intersect as well. Meshes that have a point in
/// common are hits in either case. The exception is lone triangles that are points on the grid of OutlineBuilder,
/// because outlines leave them out.
///
/// Sizes:   hits.size() == pairs.size(); an agent may be paired with itself (it collides).
/// Errors:  throws std::invalid_argument, before hits is touched, on sizes that differ, an index out of
///          range, a position or heading that is not finite or beyond the limits, unknown leaves, or an implementation that
///          this processor does not run. The message names the agent or pair and the value. Agents that no pair names are not checked.
/// Threads: runs in the caller's TBB arena, isolated from the cancellation of the caller's task group. Queries do not depend on
///          the threads' rounding mode, treatment of denormals and traps, and leave them as they are.
void collide(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const CollideOptions& options = {});

/// Tests whether the bodies of the two agents of each pair have a point in common in space, touching included, and writes 1 for a hit and
/// 0 otherwise: whether some sphere of one overlaps some sphere of the other. If the enclosed meshes intersect, the
/// answer is 1. If it is 1, the spheres are at most 4 um per metre of the two bodies' reaches apart. The answer is the
/// same bits on every processor, for any number of threads, any split of the batch and either order within a pair.
/// Levels:  bodies have one, so agents have none or 0 for all.
/// Sizes, errors, threads: as for collide() of a ShapeSet. `implementation` is as in CollideOptions.
void collide(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const Implementation* implementation = nullptr);

/// Holds the points of two agents that are nearest to each other. Each is relative to its own agent's position, in the world's axes,
/// metres, so it is a lever arm of a contact, at 1e9 m as at the origin.
struct NearestPoints {
  Vec2 first, second;
  friend bool operator==(const NearestPoints&, const NearestPoints&) = default;
};

/// Holds the output arrays of clearance(). Only `distance` is required; other arrays that are empty are not computed, which saves time.
struct ClearanceAnswers {
  std::span<float> distance;  ///< metres; infinite beyond max_distance
  std::span<Vec2> direction =
      {};  ///< unit vectors; (0, 0) beyond max_distance, and with Overlap::zero where the distance is 0
  std::span<DiscPair> discs = {};        ///< the nearest discs; DiscPair::none for the same pairs
  std::span<NearestPoints> points = {};  ///< points of these discs, or of segments; (0, 0) for the same pairs
};

/// Measures how far apart the two agents of each pair are: the least gap between a disc of one's cut and a disc of the other's, or 0
/// where discs overlap or the agents collide.
///
/// The direction is the unit vector in the world from the first agent's nearest disc to the second's. Moving the second agent along
/// it, or the first one against it, widens the gap the fastest. (penetration() returns the opposite: where the first agent moves.)
/// The points are those of the two discs that are nearest to each other, for contact responses. Along the direction they are as far
/// apart as the distance, up to 4 um per metre of the two shapes' reach and of the distance.
///
/// The distance of overlapping agents is negative with Overlap::deepest: the deepest overlap of two discs. The direction then leads
/// from one centre to the other or, where these coincide, is (1, 0) from the agent with the lower index to
/// the other. The radii of the discs limit the depth, so with fine cuts penetration() says more. Overlap::deepest measures discs only. So
/// the distance is positive for an agent inside another's outline whose discs overlap none of the other's.
///
/// With leaves = Leaves::segments, where both shapes have exact leaves, the distance is that of the outlines: the least of a
/// segment of one and a segment of the other, and 0 where they come within the margin of exact leaves. It is never larger than that of
/// the outlines as they were given, and below it by no more than 1.7 um per metre of the two shapes' reach and 0.9 um per metre of the
/// distance. The points are those of the segments, the direction leads from one to the other, and the discs are the leaves that hold
/// them. Of equal distances the one with the first segment counts. Leaves of more than 127 segments are measured as discs, after
/// all segments. Where collide() answers 1 for such agents the distance is 0; where the distance is positive, collide() answers 0.
///
/// A distance of discs is never larger than that of the outlines: outlines that cross have a clearance of at most 0. It is below the
/// distance of the outlines by no more than r_A + r_B + (r_A^2 + r_B^2) / 2 D (below 3 cm for leaf discs of 1 cm), and 4 um per metre
/// of the two shapes' reach and of D. There, r are the radii of the nearest discs, and D = distance + r_A + r_B. Only
/// the discs of the cuts count, not their ancestors, so that a positive distance is always the distance of two discs.
///
/// With Overlap::zero the distance is 0 where collide() answers 1, and collide() answers 0 where it is positive. A
/// distance of 0 does not imply a collision: collide() may answer 0 where discs overlap, but their ancestors or the
/// segments of exact leaves do not.
///
/// Results are the same bits on every processor, for any number of threads and any split of the batch. Exchanging the agents of a pair
/// exchanges the discs and negates the direction. Of gaps that are equal, the one with the first disc of the agent with the lower
/// index counts, then that with the first disc of the other.
///
/// Agents with disjoint ranges of height (Agents::z) are infinitely far from each other.
///
/// Sizes:   as many distances as pairs; as many directions, discs and points as pairs, or none. An agent may be paired with
///          itself.
/// Errors:  throws std::invalid_argument, before anything is written, as collide() does, and on a
///          max_distance that is negative or NaN, or an unknown overlap or leaves.
/// Threads: runs in the caller's TBB arena. Allocates nothing.
void clearance(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
               const ClearanceAnswers& answers, const ClearanceOptions& options = {});

/// Tests whether the two agents of each pair come within a distance of each other, and writes 1 if so and 0 otherwise. They do where
/// a disc of one's cut is within the distance of a disc of the other's. With culling data this takes about the time of collide(),
/// and clearance() takes several times as much.
///
/// Only the discs of the cuts count, as in clearance() by discs, so within() at distance 0 holds for more pairs than collide(). An agent
/// inside another's outline is within every distance of it. Agents with disjoint ranges of height are within none.
///
/// The answer is 1 wherever clearance() returns a finite distance of at most the given one, and wherever outlines are as close.
/// clearance() is at most the given distance plus 1.4 um per metre of that distance and of the radii of the agents' largest discs where
/// the answer is 1. Results are the same bits on every processor, for any number of threads and any split of the
/// batch, and for either order of a pair.
///
/// Units:   distances are metres, not negative; an infinite one includes every pair whose heights meet.
/// Sizes:   one distance for all pairs, or as many as pairs; as many answers as pairs.
/// Errors:  throws std::invalid_argument, before anything is written, as collide() does, and on a distance that is negative or
///          NaN, naming the pair where each has one.
/// Threads: runs in the caller's TBB arena. Allocates nothing.
void within(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* implementation = nullptr);

/// Holds the output arrays of clearance() of bodies, as ClearanceAnswers does, in space. Spheres have the numbers of BodySet::spheres().
struct BodyClearanceAnswers {
  /// Holds the points of two bodies that are nearest to each other, as NearestPoints does, in space.
  struct Points {
    Vec3 first, second;
    friend bool operator==(const Points&, const Points&) = default;
  };
  std::span<float> distance;
  std::span<Vec3> direction = {};
  std::span<DiscPair> spheres = {};  ///< the nearest spheres, or DiscPair::none
  std::span<Points> points = {};
};

/// Measures how far apart in space the bodies of the two agents of each pair are: the least gap between a sphere of one and a sphere of
/// the other, or with Overlap::zero 0 where spheres overlap, that is, exactly where collide() answers 1.
///
/// It is never larger than the distance of what the spheres hold, and below the gap of the spheres by no more than 6 um per metre of the
/// two bodies' reaches and of the distance. Directions, points, Overlap::deepest, ties and bits are as for a ShapeSet, in space; where
/// centres coincide, the direction is (1, 0, 0).
/// Sizes, errors, threads: as for clearance() of a ShapeSet, without levels.
void clearance(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
               const BodyClearanceAnswers& answers, const BodyClearanceOptions& options = {});

/// Tests whether the bodies of the two agents of each pair come within a distance of each other in space, and writes 1 if so and 0
/// otherwise: whether some sphere of one is within the distance of some sphere of the other. A distance of 0 gives the
/// answers of collide().
///
/// The answer is 1 wherever clearance() is at most the given distance, and clearance() is at most that and 4 um per metre of it and of the
/// largest radii where the answer is 1. It has the same bits everywhere, and in either order of a pair.
/// Units, sizes, errors, threads: as for within() of a ShapeSet, without levels. `implementation` is as in CollideOptions.
void within(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* implementation = nullptr);

/// Holds the depth of a pair along a direction: how far the first agent has to move to separate from the second, which stays.
/// penetration_along() defines it.
struct Penetration {
  float depth;  ///< metres, not negative; 0: a line across the direction separates the two
  double x, y;  ///< the direction in which the first agent moves, in the world; a unit vector within 1e-9
  friend bool operator==(const Penetration&, const Penetration&) = default;
};

/// Measures the depth of each pair along a given direction, which may have any length and is returned as a unit vector. The depth of two
/// agents A and B along a unit vector u is how far A has to move along u until no disc of its cut overlaps one of B's and neither outline
/// encloses anything of the other, there or anywhere further along u:
///
///     s(u) = max over B's discs (b . u + r) - min over A's discs (a . u - r),    depth = max(0, s(u))
///
/// a and b are the centres of discs of the cuts in the world, and r are their radii. The depth has these properties:
///
/// - *Sufficient.* After A has moved by s(u) or more, a line across u separates A and B: their discs, the outlines that these cover, and
///   what the outlines enclose. The depth is rounded up so that collide() then answers 0 if A's new position is right to 1e-7 of the two
///   shapes' reach (in doubles: up to 1e8 m or so from the origin). Where the agents are far apart, rounding the direction turns the line
///   that separates them: in float by centimetres at 1e6 m.
/// - *1-Lipschitz.* If no point of an agent moves by more than m, by shifting or turning, the depth changes by at most m. If both agents
///   move, it changes by at most both moves together. The smallest depth of several directions has this property, too. (Rounding adds
///   1e-6 of the two shapes' reach and 4e-7 of the depth.)
/// - *Symmetric.* B has to move as far along -u as A along u: the same bits, with the direction negated.
/// - *The least 1-Lipschitz depth.* Let T be the largest t >= 0 at which a disc of A's cut still overlaps one of B's when A has moved by
///   t u, or 0. Every f >= T that is 1-Lipschitz in A's position is at least s(u). Proof: let s(u) belong to two discs, and let w be how
///   far they are apart across u. Start at q, which is n behind A along u and w beside it. From there the two discs touch last at n + s(u).
///   So f(A) >= f(q) - |q - A| >= n + s(u) - sqrt(n^2 + w^2), for every n.
///
/// The price: the depth may be positive where nothing overlaps yet, because one agent may reach around the other. Along a given direction
/// no 1-Lipschitz depth can be zero there: if A touches B from behind, A still has to pass all of B. So query only pairs that collide. Over
/// all directions, the way to the nearest place without overlapping discs lies between two bounds, and both are 1-Lipschitz. The lower one
/// is the deepest overlap of two discs (clearance() with Overlap::deepest). It is zero until they touch, and suits forces that grow from
/// contact on. The upper one is this depth, and suits corrections of positions that are applied at once.
///
/// Agents with disjoint ranges of height (Agents::z) have a depth of 0. The answer is the same bits on every processor, for any number of
/// threads and any split of the batch. Only the difference of positions counts.
/// Sizes:   as many directions and answers as pairs; the set need not have outlines. An agent may be paired with
///          itself: then it has to move by its own width.
/// Errors:  throws std::invalid_argument, before out is touched, like collide(), and on a direction that is zero or not
///          finite, naming the pair.
/// Memory:  allocates nothing.
/// Threads: runs in the caller's TBB arena.
void penetration_along(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                       std::span<const Vec2> directions, std::span<Penetration> out,
                       const Implementation* implementation = nullptr);

/// Measures the least depth of each pair along `directions` evenly spread directions, the first of which is the x axis.
/// Call it for pairs that collide. Usual numbers k of directions are 16 to 32, and the time is proportional to k. Of equal depths,
/// the one of the first direction in the order 0, k / 2, 1, k / 2 + 1 ... counts, as seen from the agent with the lower index.
/// Everything else is as for penetration_along().
/// Errors:  also on a number of directions that is odd, which would not be symmetric, below 2 or above 256.
void penetration(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                 std::uint32_t directions, std::span<Penetration> out,
                 const Implementation* implementation = nullptr);

/// Measures how far the first agent of each pair has to move on the ground along a given direction until a line
/// separates the spheres of the two as seen from above. collide() then answers 0. The depth is 0 for bodies with
/// disjoint ranges of height. All else is as for a ShapeSet.
void penetration_along(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                       std::span<const Vec2> directions, std::span<Penetration> out,
                       const Implementation* implementation = nullptr);

/// Measures the same along evenly spread directions, as penetration() of a ShapeSet does.
void penetration(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                 std::uint32_t directions, std::span<Penetration> out,
                 const Implementation* implementation = nullptr);

/// Measures how far the first agent of each pair has to move on the ground, along the best of `directions`
/// evenly spread directions, to separate from the second: until no segments of the two outlines meet or,
/// where collide() tests discs, no discs of the cuts overlap. The agents may remain interlocked: no line need
/// separate them. So the depth is at most that of penetration(), up to rounding. collide() answers 0
/// afterwards; where it answers 0 before, the depth is 0. It grows from 0 at contact, and may jump where a
/// gap opens or closes. Sizes, symmetry, directions and errors are those of penetration(), and of collide()
/// for leaves; the bits are the same on every processor.
/// Memory:  allocates in every call. Threads: runs in the caller's TBB arena.
void nearest_free(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const CollideOptions& options = {});

/// Measures the same until no sphere of the first agent's body overlaps one of the second's.
void nearest_free(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out,
                  const Implementation* implementation = nullptr);

/// Holds the displacement of the first agent of each pair relative to the second: its own displacement minus the
/// other's. Beside obstacles there is one for each agent, in the world. No agent turns.
/// Units:   metres in the world; each within +-1e9.
/// Sizes:   z is empty, so that nobody moves up or down, or of bodies of spheres as long as x and y.
struct Displacements {
  std::span<const double> x, y, z = {};
};

/// Finds when the two agents of each pair first touch while they move without turning. The time is the least t in [0, 1] at which
/// discs of their cuts touch when the first agent has moved by t times its displacement, or infinity if there is none. It is 0 where
/// the agents collide already.
///
/// Only the discs of the cuts count, not their ancestors: ancestors may start to overlap later on the way, which would
/// make the time late. The time is 0 where discs of the cuts overlap already, even if the agents move apart. If the
/// displacement rounds to zero in float, the time is 0 where collide() with Leaves::discs answers 1, and infinity
/// elsewhere.
///
/// The time is never later than the outlines' first contact. At that time the outlines are apart by at most the two
/// discs' diameters plus 4 um per metre of way and of the two shapes' reaches. So the time may be early, or finite
/// where the outlines only pass each other within that distance. Times are the same bits on every processor, for any
/// number of threads and any split of the batch, and for exchanged agents with the displacement negated.
///
/// Agents with disjoint ranges of height (Agents::z) never touch.
///
/// Sizes:   as many displacements in x, in y, and times as pairs. An agent may be paired with itself (0).
/// Errors:  throws std::invalid_argument, before anything is written, as collide() does, and on a
///          displacement that is not finite or beyond the limits.
/// Threads: runs in the caller's TBB arena. Allocates nothing.
/// Source:  the slide of the paper's experiment, which the paper makes in small steps.
void time_of_impact(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                    const Displacements& displacements, std::span<float> times,
                    const Implementation* implementation = nullptr);

/// Finds when the bodies of the two agents of each pair first touch in space while they move without turning: the least
/// t in [0, 1] at which some sphere of one touches some sphere of the other when the first agent has moved by t times
/// its displacement, or infinity if there is none. It is 0 where collide() answers 1.
///
/// The time is never later than the first contact of what the spheres hold. At that time the spheres are at most 6 um per metre of way
/// and of the two bodies' reaches apart. So the time may be early, or finite where the spheres only pass each other
/// within that distance. Bits are as for a ShapeSet.
/// Sizes, errors, threads: as for time_of_impact() of a ShapeSet, without levels.
void time_of_impact(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                    const Displacements& displacements, std::span<float> times,
                    const Implementation* implementation = nullptr);

}  // namespace bch
