// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/query.hpp>

namespace bch {

/// Stands for the discs of a pair that has none in clearance(): it is beyond max_distance, or overlaps with Overlap::zero.
constexpr DiscPair no_discs{0xffffffff, 0xffffffff};

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
  std::span<DiscPair> discs = {};        ///< the nearest discs; no_discs for the same pairs
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
/// the other. The radii of the discs limit the depth, so with fine cuts penetration() says more. It is about discs alone, and so
/// positive for an agent that lies clear inside another's outline.
///
/// With distance_leaves = Leaves::segments, where both shapes have exact leaves, the distance is that of the outlines: the least of a
/// segment of one and a segment of the other, and 0 where they come within the margin of exact leaves. It is never larger than that of
/// the outlines as they were given, and below it by no more than 1.7 um per metre of the two shapes' reach and 0.9 um per metre of the
/// distance. The points are those of the segments, the direction leads from one to the other, and the discs are the leaves that hold
/// them. Of equal distances the one with the first segment counts. Leaves of more than 127 segments are measured as discs, after
/// all segments. Where collide() answers 1 for such agents the distance is 0; where the distance is positive, collide() answers 0.
///
/// A distance of discs is never larger than that of the outlines: outlines that cross have a clearance of at most 0. It is below the
/// distance of the outlines by no more than r_A + r_B + (r_A^2 + r_B^2) / 2 D (below 3 cm for leaf discs of 1 cm), and 4 um per metre
/// of the two shapes' reach and of D. There, r are the radii of the nearest discs, and D = distance + r_A + r_B. Only the discs
/// of the cuts count, not the nodes above them, so that a positive distance is always the distance of two discs.
///
/// With Overlap::zero the distance is 0 where collide() answers 1, and collide() answers 0 where it is positive. A distance of 0
/// does not imply a collision: collide() may answer 0 where discs overlap, but nodes above them or the segments of exact leaves do not.
///
/// Results are the same bits on every processor, for any number of threads and any split of the batch. Exchanging the agents of a pair
/// exchanges the discs and negates the direction. Of gaps that are equal, the one with the first disc of the agent with the lower
/// index counts, then that with the first disc of the other.
///
/// Bodies in slabs, or at different heights, have the least distance of the parts that may meet; in a tie that of the lowest
/// slabs. Where no parts may meet, the distance is infinite.
///
/// Options: max_distance, overlap, distance_leaves, implementation.
/// Sizes:   as many distances as pairs; as many directions, discs and points as pairs, or none. An agent may be paired with
///          itself.
/// Errors:  throws std::invalid_argument, before anything is written, as collide() does, and on a
///          max_distance that is negative or NaN, or an unknown overlap or distance_leaves.
/// Threads: runs in the caller's TBB arena. Allocates nothing, except for bodies in slabs or at different heights.
void clearance(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
               const ClearanceAnswers& answers, const QueryOptions& options = {});

/// Tests whether the two agents of each pair come within a distance of each other, and writes 1 if so and 0 otherwise. They do where
/// a disc of one's cut is within the distance of a disc of the other's. With culling data this takes about the time of collide(),
/// and clearance() takes several times as much.
///
/// Only the discs of the cuts count, whatever distance_leaves says, as in clearance(): more pairs are within a distance of 0 than
/// collide. An agent inside another's outline is within every distance of it. Distances of bodies in slabs are those of parts that
/// may meet.
///
/// The answer is 1 wherever clearance() returns a finite distance of at most the given one, and wherever outlines are as close.
/// clearance() is at most the given distance plus 1.4 um per metre of that distance and of the radii of the agents' largest discs where
/// the answer is 1. Results are the same bits on every processor, for any number of threads and any split of the
/// batch, and for either order of a pair.
///
/// Options: implementation.
/// Units:   distances are metres, not negative; an infinite one includes every pair of which parts may meet.
/// Sizes:   one distance for all pairs, or as many as pairs; as many answers as pairs.
/// Errors:  throws std::invalid_argument, before anything is written, as collide() does, and on a distance that is negative or
///          NaN, naming the pair where each has one.
/// Threads: runs in the caller's TBB arena. Allocates nothing.
void within(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const QueryOptions& options = {});

}  // namespace bch
