// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/body_set.hpp>
#include <bch/query.hpp>

namespace bch {

/// Tests whether the two agents of each pair collide at their levels: writes 1 for a hit and 0 otherwise.
/// Touching is a collision, and none is missed; "Collisions" in kernel/accuracy.md bounds the false ones.
/// Agents with a z (Agents::z) collide only if their ranges of height intersect, too.
/// Sizes:   hits.size() == pairs.size(); an agent may be paired with itself (it collides).
/// Errors:  throws std::invalid_argument, before hits is touched, on sizes that differ, on an unsupported
///          implementation, and on an index, position, heading or leaves out of range, naming the agent or
///          pair and the value.
/// Threads: runs in the caller's TBB arena.
void collide(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const CollideOptions& options = {});

/// Tests whether the bodies of the two agents of each pair overlap: writes 1 for a hit and 0 otherwise.
/// They do if some sphere of one overlaps some sphere of the other, touching included. If the enclosed meshes
/// intersect, the answer is 1; "Bodies of spheres" in kernel/accuracy.md bounds the false hits. Bodies have
/// one level: Agents::level is empty or all 0.
/// Sizes, errors, threads: as for collide() of a ShapeSet; `implementation` is as in CollideOptions.
void collide(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const Implementation* implementation = nullptr);

/// Holds the points of two agents that are nearest to each other.
/// Each is relative to its own agent's position, in the world's axes, metres. So it is the lever arm of a
/// contact, and equally exact far from the origin.
struct NearestPoints {
  Vec2 first, second;
  friend bool operator==(const NearestPoints&, const NearestPoints&) = default;
};

/// Holds the output arrays of clearance(). Only `distance` is required.
/// Other arrays that are empty are not computed, which saves time.
struct ClearanceAnswers {
  std::span<float> distance;  ///< metres; infinite beyond max_distance
  std::span<Vec2> direction =
      {};  ///< unit vectors; (0, 0) beyond max_distance, and with Overlap::zero where the distance is 0
  std::span<DiscPair> discs = {};        ///< the nearest discs; DiscPair::none where the direction is (0, 0)
  std::span<NearestPoints> points = {};  ///< points of these discs, or of segments; else (0, 0)
};

/// Measures how far apart the two agents of each pair are.
/// That is the least gap between discs of their cuts, or with Leaves::segments between their outlines. It is
/// 0 (with Overlap::deepest negative) where these overlap or the agents collide, and infinite where ranges of
/// height are disjoint. "Distances" in kernel/accuracy.md has the errors.
/// Sizes:   as many distances as pairs; as many directions, discs and points as pairs, or none.
/// Errors:  as collide(), and on a max_distance that is negative or NaN, or an unknown overlap or leaves.
/// Threads: runs in the caller's TBB arena. Allocates nothing.
void clearance(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
               const ClearanceAnswers& answers, const ClearanceOptions& options = {});

/// Tests whether the two agents of each pair come within a distance: writes 1 if so and 0 otherwise.
/// They do if a disc of one cut is within the distance of a disc of the other, or one agent is inside the
/// other's outline. This is several times as fast as clearance(); see also kernel/accuracy.md.
/// Units:   distances are metres, not negative; an infinite one includes every pair whose heights meet.
/// Sizes:   one distance for all pairs, or as many as pairs; as many answers as pairs.
/// Errors:  as collide(), and on a distance that is negative or NaN, whose pair is named.
/// Threads: runs in the caller's TBB arena. Allocates nothing.
void within(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* implementation = nullptr);

/// Holds the output arrays of clearance() of bodies, as ClearanceAnswers does, in space.
/// Spheres have the numbers of BodySet::spheres().
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

/// Measures how far apart in space the bodies of the two agents of each pair are.
/// That is the least gap between a sphere of one and a sphere of the other; with Overlap::zero it is 0
/// exactly where collide() answers 1. Directions, points, Overlap::deepest and ties are as for a ShapeSet, in
/// space; where centres coincide, the direction is (1, 0, 0). "Bodies of spheres" in kernel/accuracy.md has
/// the errors.
/// Sizes, errors, threads: as for clearance() of a ShapeSet, without levels.
void clearance(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
               const BodyClearanceAnswers& answers, const BodyClearanceOptions& options = {});

/// Tests whether some sphere of one body is within a distance of some sphere of the other, in space.
/// Writes 1 if so and 0 otherwise. A distance of 0 gives the answers of collide(). "Bodies of spheres" in
/// kernel/accuracy.md compares it with clearance().
/// Units, sizes, errors, threads: as for within() of a ShapeSet, without levels; `implementation` is as in
///   CollideOptions.
void within(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* implementation = nullptr);

/// Holds how far, and in which direction, the first agent of a pair moves to separate from the second.
struct Penetration {
  /// Holds where the two touch after a move of nearest_free(): at the segments or spheres that separate last.
  /// Two segments touch at an end of one, and the normal is perpendicular to the other. Normals never point
  /// against the move. Depths include the rounding, so the two are then a few micrometres per metre of their
  /// extents apart. A leaf of more than 127 segments is treated as a disc, which may add its diameter.
  struct Touch {
    Vec3 point;   ///< relative to the first agent's position after the move, in the world's axes; metres
    Vec3 normal;  ///< of length 1 within 1e-6, from the second agent to the first; (0, 0, 0): no collision
    friend bool operator==(const Touch&, const Touch&) = default;
  };

  float depth;  ///< metres, not negative; 0: a line perpendicular to the direction separates the two
  double x, y;  ///< the direction in which the first agent moves, in the world; of length 1 within 1e-9
  friend bool operator==(const Penetration&, const Penetration&) = default;
};

/// Measures how far the first agent of each pair moves along a given direction to separate from the second.
/// After the move, a line separates all discs of the two, and collide() answers 0. Call this function only
/// for pairs that collide: the depth of other pairs may be positive, too. The depth is 0 if the agents'
/// ranges of height are disjoint. "Penetration" in kernel/accuracy.md defines the depth and proves its
/// properties.
/// Sizes:   as many directions, of any length, and answers as pairs.
/// Errors:  as collide(), and on a direction that is zero or not finite, naming the pair.
/// Threads: runs in the caller's TBB arena. Allocates nothing.
void penetration_along(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                       std::span<const Vec2> directions, std::span<Penetration> out,
                       const Implementation* implementation = nullptr);

/// Measures the least depth of each pair along `directions` evenly spread directions.
/// The first direction is the x axis. 16 to 32 directions are usual; the time is proportional to their number
/// k. Of equal depths, that of the first direction in the order 0, k / 2, 1, k / 2 + 1 ... is chosen, where
/// directions are those of the agent with the lower index. Everything else is as for penetration_along().
/// Errors:  also on a number of directions that is odd (which would not be symmetric), below 2 or above 256.
void penetration(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                 std::uint32_t directions, std::span<Penetration> out,
                 const Implementation* implementation = nullptr);

/// Measures how far the first body moves along a given direction to separate from the second.
/// It moves on the ground, until a line separates the spheres of the two as seen from above. Everything else
/// is as for a ShapeSet.
void penetration_along(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                       std::span<const Vec2> directions, std::span<Penetration> out,
                       const Implementation* implementation = nullptr);

/// Measures the same along evenly spread directions, as penetration() of a ShapeSet does.
void penetration(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                 std::uint32_t directions, std::span<Penetration> out,
                 const Implementation* implementation = nullptr);

/// Measures how far the first agent of each pair moves on the ground until the two no longer collide.
/// It moves along the best of `directions` evenly spread directions, until no segments of the two outlines
/// meet or, if collide() tests discs, no discs of the cuts overlap; then collide() answers 0. No line need
/// separate the two, so the depth is at most that of penetration(), up to rounding. It is 0 if they do not
/// collide, grows from 0 at contact, and may jump where a gap opens or closes. Sizes, symmetry, directions
/// and errors are those of penetration() and collide(); touches.size() is out.size() or 0.
/// Memory:  allocates in every call. Threads: runs in the caller's TBB arena.
void nearest_free(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const CollideOptions& options = {},
                  std::span<Penetration::Touch> touches = {});

/// Measures how far the first body of each pair moves until none of its spheres overlaps one of the second's.
/// The point of touch is on a sphere of the first agent, and the normal leads along the two spheres' centres.
void nearest_free(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out,
                  const Implementation* implementation = nullptr, std::span<Penetration::Touch> touches = {});

/// Holds how far the first agent of each pair moves relative to the second.
/// That is its own displacement minus the other's. For queries of obstacles it holds each agent's own
/// displacement, in the world. No agent turns.
/// Units:   metres in the world; each within +-1e9.
/// Sizes:   z.size() == 0: nobody moves up or down; for bodies of spheres also z.size() == x.size().
struct Displacements {
  std::span<const double> x, y, z = {};
};

/// Finds when the two agents of each pair first touch while they move by their displacements without turning.
/// The time is the least t in [0, 1] at which discs of their cuts touch, or infinity if there is none. It is
/// 0 where the agents collide already, and never later than the outlines' first contact; "Times of impact" in
/// kernel/accuracy.md says how early it may be.
/// Sizes:   as many displacements in x, in y, and times as pairs. An agent paired with itself has time 0.
/// Errors:  as collide(), and on a displacement that is not finite or beyond the limits.
/// Threads: runs in the caller's TBB arena. Allocates nothing.
/// Source:  the test by translation of Stuvel et al. (2014), who move in small steps.
void time_of_impact(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                    const Displacements& displacements, std::span<float> times,
                    const Implementation* implementation = nullptr);

/// Finds when two bodies first touch in space while they move by their displacements without turning.
/// The time is the least t in [0, 1] at which some sphere of one touches some sphere of the other, or
/// infinity if there is none. It is 0 where collide() answers 1; "Times of impact" in kernel/accuracy.md has
/// the errors.
/// Sizes, errors, threads: as for time_of_impact() of a ShapeSet, without levels.
void time_of_impact(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                    const Displacements& displacements, std::span<float> times,
                    const Implementation* implementation = nullptr);

}  // namespace bch
