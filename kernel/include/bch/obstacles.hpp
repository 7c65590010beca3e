// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <bch/clearance.hpp>
#include <bch/penetration.hpp>
#include <bch/query.hpp>
#include <bch/time_of_impact.hpp>

namespace bch::detail {
struct ObstacleView;
}

namespace bch {

/// Obstacles in arrays of the caller: points, paths of points, and obstacles of paths, each by where it begins (CSR). A path of one
/// point is a post; one without points is nothing.
/// Units:   metres in the world; |x|, |y| <= 1e9.
struct ObstacleArrays {
  std::span<const double> x, y;                 ///< the points of all paths
  std::span<const std::uint64_t> path_offsets;  ///< path p has points [p] .. [p + 1]; one more than paths
  std::span<const std::uint64_t> obstacle_offsets =
      {};                                      ///< obstacle o has paths [o] .. [o + 1]; empty: one each
  std::span<const std::uint8_t> is_area = {};  ///< by obstacle, see ObstacleSet; empty: none is
};

/// The meaning of polygons in a file.
enum class Polygons {
  solid,     ///< an obstacle that holds what it encloses
  walkable,  ///< the floor that agents walk on: its rings are walls, as lines
};

/// Obstacles that do not move: walls, pillars, furniture. Each is a set of points of the ground, of infinite height.
///
/// - A line is one or more open polylines.
/// - An area is one or more rings, which close themselves, and the points that they enclose by the even-odd rule: the first ring is the
///   border of a polygon, and the others are holes in it.
///
/// Obstacles may cross, touch, nest and repeat each other and themselves; penetration() alone wants polygons that are simple.
/// Segments are numbered in the order of the paths. An object that was moved from can only be assigned to or destroyed.
/// Threads: any number of queries may read one at once.
class ObstacleSet {
 public:
  /// Copies the obstacles, sorts their segments into a tree of boxes, and measures distances from them in a grid.
  /// Cost:    2 s for 10^6 segments, and 125 bytes for each. Runs in the caller's TBB arena.
  /// Errors:  throws std::invalid_argument on sizes that differ, offsets that descend or lead beyond what there is, and a point that is not finite
  ///          or beyond the limits, naming it; std::length_error beyond 2^31 points, paths
  ///          and obstacles.
  explicit ObstacleSet(const ObstacleArrays& obstacles);
  ObstacleSet(ObstacleSet&&) noexcept;
  ObstacleSet& operator=(ObstacleSet&&) noexcept;
  ~ObstacleSet();

  std::uint32_t obstacle_count() const noexcept;
  std::uint32_t segment_count() const noexcept;
  /// Returns the obstacle that a segment belongs to.
  /// Errors:  throws std::out_of_range on an index out of range.
  std::uint32_t obstacle_of(std::uint32_t segment) const;

  /// Returns what the library's own parts read; they alone know the type.
  const detail::ObstacleView& view() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads obstacles from well-known text, as JuPedSim and geographic information systems write it: any number of POLYGON,
/// MULTIPOLYGON, LINESTRING, MULTILINESTRING and GEOMETRYCOLLECTION, one after the other. Each polygon and each line is an
/// obstacle, of walkable polygons each ring; what is empty is none.
/// Errors:  throws std::invalid_argument on text that is not, with its line and column, what stands there and what was
///          expected; and as ObstacleSet does.
ObstacleSet obstacles_from_wkt(std::string_view text, Polygons polygons = Polygons::solid);

// Queries of agents against obstacles. Each answers every agent as the query of the same name answers pairs: defined without a traversal, the
// same bits on every processor and for any number of threads, never a miss, far from the origin as at it. A disc overlaps an obstacle where
// its centre is at most its radius away from it; distances are computed in double. A false positive has a gap of at most the sizes of
// discs, 4 um per metre of an agent's reach, and 1e-14 of the distance to the ends of a segment. A body in slabs meets an obstacle
// where some part of it does, and an agent's height does not matter.
//
// Sizes:   one answer an agent.
// Errors:  throw std::invalid_argument, before anything is written, as validate(shapes, agents) and the query of pairs.
// Threads: run in the caller's TBB arena.
// Memory:  in proportion to the segments that are near 64 agents, for each task.

/// Answers each agent: 1 where it collides with an obstacle, touching included, else 0. A disc of its cut overlaps the
/// obstacle then, and so does every node above it. With exact leaves the outline in that disc does, too. An agent inside an
/// area always collides; in solid semantics so does one whose outline holds a whole path of an obstacle.
/// Options: semantics, leaves, implementation.
void collide(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const QueryOptions& options = {});

/// Answers each agent: 1 where a disc of its cut comes as close to an obstacle as a distance, else 0; one distance for all
/// agents, or one each. It is 1 where clearance() with the same distance_leaves and no limit is at most the distance, but for rounding that to
/// float; in solid semantics also where the agent's outline holds a whole path.
/// Options: semantics, distance_leaves, implementation.
void within(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const QueryOptions& options = {});

/// Measures how far each agent is from the nearest obstacle: the least gap between a disc of its cut and a segment, 0 where they
/// overlap or an area holds a disc. The direction leads from the agent to the obstacle. `discs` has the agent's disc and the
/// segment, of equal gaps the first disc and then the first segment. `points` are both from the agent's position.
/// With Overlap::deepest the distance of a disc that a segment crosses is negative, and its direction is that to the segment's nearest point,
/// (1, 0) where that is the disc's centre. An agent that an area holds clear of its segments is as far from those as they are.
///
/// With distance_leaves = Leaves::segments, where the agent has exact leaves, the distance is that of its outline: the least from a segment of it to
/// one of the obstacle, 0 where they come within the margin of exact leaves or an area holds something of the outline. It is never larger than that of the
/// outline as it was given, and below it by no more than 1.2 um per metre of reach, 0.12 um per metre of the distance and 4e-15 of
/// the distance to the ends of the segment. The points are those of the two segments, and the disc is the leaf that holds the agent's. Of equal distances
/// that with the first segment of the outline counts, then the first of the obstacle. A leaf of more than 127 segments is measured as a disc, after
/// all segments. Where collide() says 1 in boundary semantics the distance is 0; where it is positive, collide() says 0 there.
/// Options: max_distance, overlap, distance_leaves, implementation.
void clearance(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
               const ClearanceAnswers& answers, const QueryOptions& options = {});

/// Measures how far each agent has to move to leave an obstacle, and in which direction. Every move is at right angles to one
/// segment. Out of an area, it goes across the line of a side to the side's outer face until all discs have passed it. Away from a
/// line, it goes to either side until no disc overlaps the touched stretch, and away from a post along the disc that is nearest to it. Of all such moves
/// the shortest counts. An agent that touches several obstacles gets the one with the longest move; one that an area holds clear of its segments
/// goes over the nearest of them. One move frees an agent of a convex area or a single segment, if
/// its new position is right to 1e-7 of its reach; elsewhere call again. The depth is
/// 0, and the direction (0, 0), where nothing is touched.
/// Options: implementation.
void penetration(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                 std::span<Penetration> out, const QueryOptions& options = {});

/// Finds when each agent first touches an obstacle on its way: the least t in [0, 1] at which a disc of its cut overlaps one, when the
/// agent has moved by t times its displacement without turning; infinity where none does. It is 0 inside an area, and where the outline of a body in slabs
/// holds a whole path.
/// Options: implementation.
void time_of_impact(const ShapeSet& shapes, const Agents& agents, const Displacements& displacements,
                    const ObstacleSet& obstacles, std::span<float> times, const QueryOptions& options = {});

/// Finds when each motion first touches an obstacle: the earliest time of an interval at which its solid has a point in common with one, infinity
/// where it has none. That of a body in slabs is the first of any slab.
///
/// The time is never later than the first contact. At that time the solid is at most the tolerance away, and 4 um for each metre of its
/// reach and what double rounds, as between two motions; of the distance to the ends of a segment 1e-14. Times are the same bits on every processor, for
/// any number of threads and any split of the batch; a later end of the interval changes no time.
///
/// Units:   as first_contact() of pairs.
/// Sizes:   as many times as motions.
/// Errors:  throws std::invalid_argument, before anything is written, as first_contact() of pairs.
void first_contact(std::span<const Motion> motions, const ObstacleSet& obstacles,
                   const TimeInterval& interval, std::span<double> times, double tolerance = 0.005);

/// Returns until when a motion has contact with none of others and with no obstacle: the least of what first_contact() says of both.
/// Errors:  as free_until() without obstacles.
/// Threads: one; several may ask at once.
double free_until(const Motion& motion, std::span<const Motion> others, const ObstacleSet& obstacles,
                  const TimeInterval& interval, double tolerance = 0.005);

}  // namespace bch
