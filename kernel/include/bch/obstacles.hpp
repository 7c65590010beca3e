// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include <bch/body_set.hpp>
#include <bch/motion.hpp>
#include <bch/pairs.hpp>
#include <bch/query.hpp>

namespace bch::detail {
struct ObstacleView;
}

namespace bch {

/// Holds obstacles in arrays of the caller: points, paths made of points, and obstacles made of paths, as offsets (CSR). A path of one
/// point is a post; a path without points is ignored.
/// Units:   metres in the world, heights in that of Agents::z; |x|, |y| <= 1e9, heights are numbers or infinite.
struct ObstacleArrays {
  std::span<const double> x, y;                 ///< the points of all paths
  std::span<const std::uint64_t> path_offsets;  ///< path p has points [p] .. [p + 1]; one more than paths
  std::span<const std::uint64_t> obstacle_offsets =
      {};                                      ///< obstacle o has paths [o] .. [o + 1]; empty: one path each
  std::span<const std::uint8_t> is_area = {};  ///< per obstacle, see ObstacleSet; empty: no areas
  std::span<const double> bottom = {}, top = {};  ///< per obstacle, heights; empty: infinite
};

/// Selects the meaning of polygons in a file.
enum class Polygons {
  solid,     ///< each polygon is an obstacle that holds what it encloses
  walkable,  ///< each polygon is the floor that agents walk on: its rings are walls, as lines
};

/// Holds obstacles that do not move: walls, pillars, furniture. Each is a set of points of the ground. It may have heights, as barriers,
/// lintels and the walls of one floor have; else its height is infinite.
///
/// - A line is one or more open polylines.
/// - An area is one or more rings, which close themselves, and the points that they enclose by the even-odd rule. The first ring is the
///   border of a polygon, and the others are holes in it.
///
/// Obstacles may cross, touch, nest and repeat each other and themselves; only penetration() needs simple polygons.
/// Segments are numbered in the order of the paths. An object that was moved from can only be assigned to or destroyed.
/// Threads: any number of queries may read one set at once.
class ObstacleSet {
 public:
  /// Copies the obstacles, sorts their segments into a tree of boxes, and fills a grid with the distances to them.
  /// Cost:    2 s for 10^6 segments, and 125 bytes for each. Runs in the caller's TBB arena.
  /// Errors:  throws std::invalid_argument on sizes that differ, on offsets that descend or lead out of their array, and, naming it, on a
  ///          point that is not finite or beyond the limits, or on an obstacle whose bottom is not at most its top; std::length_error
  ///          beyond 2^31 points, paths and obstacles.
  explicit ObstacleSet(const ObstacleArrays& obstacles);
  ObstacleSet(ObstacleSet&&) noexcept;
  ObstacleSet& operator=(ObstacleSet&&) noexcept;
  ~ObstacleSet();

  std::uint32_t obstacle_count() const noexcept;
  std::uint32_t segment_count() const noexcept;
  /// Returns the obstacle that a segment belongs to.
  /// Errors:  throws std::out_of_range on an index out of range.
  std::uint32_t obstacle_of(std::uint32_t segment) const;

  // For the library's own parts, which alone know these types.
  /// Returns the arrays that queries read.
  const detail::ObstacleView& view() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads obstacles from well-known text, as JuPedSim and geographic information systems write it. The text is any number of POLYGON,
/// MULTIPOLYGON, LINESTRING, MULTILINESTRING and GEOMETRYCOLLECTION, one after the other. Each line and each solid polygon is one
/// obstacle; of walkable polygons each ring is one. Empty geometries give no obstacle. All obstacles reach from `bottom` to `top`. The
/// numbers of Z, M and ZM, with or without a space before these, are read and ignored, NaN included. So are the reference system of
/// extended text (SRID=4326;), its third and fourth coordinates, which it does not name, and a byte order mark.
/// Errors:  throws std::invalid_argument on malformed text, with the line and column, what stands there and what was
///          expected; and as ObstacleSet does. Columns count bytes. Bytes that cannot be printed are escaped, in hexadecimal.
ObstacleSet obstacles_from_wkt(std::string_view text, Polygons polygons = Polygons::solid,
                               double bottom = -std::numeric_limits<double>::infinity(),
                               double top = std::numeric_limits<double>::infinity());

// Queries of agents against obstacles. Each answers every agent as the query of the same name answers every pair: it is defined without a
// traversal, gives the same bits on every processor and for any number of threads, never misses a contact, and answers far from the
// origin as at it. A disc overlaps an obstacle if the distance from its centre to the obstacle is at most its radius;
// distances are computed in double. A false positive has a gap of at most a disc's diameter, 4 um per metre of an
// agent's reach, and 9e-15 of the distances to the two ends of a segment together.
//
// A body is compared only with obstacles whose heights meet its own, as between agents with a z: touching counts, and heights are widened
// by their rounding. The query ignores all other obstacles, their segments and their areas. A body's heights are metres above the agent's
// z, or above 0 if agents have none. Sets keep them with ShapeSetPlan::heights; a body without heights is infinite, and meets obstacles at
// all heights.
//
// Sizes:   one answer per agent.
// Errors:  throw std::invalid_argument, before anything is written, as validate(shapes, agents) and the query of pairs.
// Threads: run in the caller's TBB arena.
// Memory:  in proportion to the segments that are near 64 agents, for each task.

/// Tests whether each agent collides with an obstacle, touching included, and writes 1 for a hit and 0 otherwise. An agent
/// collides if a disc of its cut and all ancestors of that disc overlap the obstacle. With exact leaves the outline in
/// that disc has to overlap it, too. An agent inside an area always collides, and so does one whose outline holds a
/// whole path of an obstacle.
void collide(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const CollideOptions& options = {});

/// Tests whether a disc of each agent's cut comes within a distance of an obstacle, and writes 1 if so and 0 otherwise. There is one
/// distance for all agents, or one each. The answer is 1 where clearance() with the same leaves and no limit is at most the
/// distance, apart from the rounding of that clearance to float.
void within(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers, Leaves leaves = Leaves::discs,
            const Implementation* implementation = nullptr);

// Queries of bodies of spheres. An obstacle stands upright, from its bottom to its top, on its line or over its area. A
// sphere touches it if the distance from its centre to that solid is at most its radius. If an enclosed mesh meets an
// obstacle, the answer is a hit. Distances are computed in double, with the same bits on every processor and for any
// number of threads. Sizes, errors, threads and memory are as above.

/// Tests whether some sphere of each agent touches an obstacle, and writes 1 for a hit and 0 otherwise.
void collide(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const Implementation* implementation = nullptr);

/// Tests whether some sphere of each agent comes within a distance of an obstacle, metres, and writes 1 if so and 0 otherwise. There is one
/// distance for all agents, or one each.
void within(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* implementation = nullptr);

/// Measures how far each agent is in space from the nearest obstacle: the least gap between a sphere and an obstacle, or with
/// Overlap::zero 0 where they touch. The direction leads from the agent to the obstacle; `spheres` holds the indices of
/// the sphere and of the segment. The latter is 2^32 - 1 for a sphere above, in or below an area. Points are relative
/// to the agent's position. Of equal gaps that of the first obstacle counts. Where collide() answers 1 the distance is
/// 0, and nowhere else.
void clearance(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
               const BodyClearanceAnswers& answers, const BodyClearanceOptions& options = {});

/// Measures how far each agent is from the nearest obstacle: the least gap between a disc of its cut and a segment, or 0 where they
/// overlap, a disc is inside an area, or a whole path is inside the agent's outline. The direction leads from the agent to the obstacle.
/// `discs` has the agent's disc and the number of the segment; of equal gaps the first disc counts, and then the first segment. `points`
/// are both relative to the agent's position.
///
/// The distance of a disc that a segment crosses is negative with Overlap::deepest. Its direction is that to the segment's nearest point,
/// or (1, 0) where that point is the disc's centre. An agent that is inside an area and touches none of its segments then has its distance
/// to these segments, and one whose outline holds a whole path the distance to that.
///
/// With leaves = Leaves::segments, where the agent has exact leaves, the distance is that of its outline: the least from a
/// segment of it to one of the obstacle, and 0 where they come within the margin of exact leaves or an area holds something of the
/// outline. It is never larger than that of the outline as it was given, and below it by no more than 1.2 um per metre of reach, 0.12 um
/// per metre of the distance and 9e-15 of the distances to the two ends of the segment together, which is 9 um beside the middle of a wall
/// of 1e9 m. The points are those of the two segments, and the disc is the leaf that holds the agent's point. Of equal distances that with
/// the first segment of the outline counts, then the first of the obstacle. A leaf of more than 127 segments is
/// measured as a disc, after all segments. Where collide() answers 1 the distance is 0; where the distance is positive,
/// collide() answers 0.
void clearance(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
               const ClearanceAnswers& answers, const ClearanceOptions& options = {});

/// Measures how far each agent has to move to leave an obstacle, and in which direction. Every move is at right angles to one
/// segment:
///
/// - Out of an area, the agent crosses the line of a side, to the side's outer face, until all discs have passed the line.
/// - Away from a line, it goes to either side until no disc overlaps the touched stretch.
/// - Away from a post, it goes along the disc that is nearest to the post.
///
/// The shortest of all such moves out of an obstacle counts. An agent that is inside an area and touches none of its segments crosses the
/// nearest of them. An agent that touches or is inside several obstacles gets the longest of the moves that each of them alone asks for.
/// One move frees an agent of a convex area or a single segment, if its new position is right to 1e-7 of its reach; for other obstacles,
/// call again after the move. The depth is 0, and the direction (0, 0), where nothing is touched, even if the outline
/// encloses a whole path that no disc overlaps.
/// Cost:    n log n, n being the segments near the agent or no farther than the farthest that it crosses.
void penetration(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                 std::span<Penetration> out, const Implementation* implementation = nullptr);

/// Finds when each agent first touches an obstacle while it moves by its displacement without turning. The time is the least t in [0, 1]
/// at which a disc of the agent's cut overlaps an obstacle when the agent has moved by t times its displacement, or infinity if there is
/// none. It is 0 inside an area, and where the agent's outline holds a whole path.
void time_of_impact(const ShapeSet& shapes, const Agents& agents, const Displacements& displacements,
                    const ObstacleSet& obstacles, std::span<float> times,
                    const Implementation* implementation = nullptr);

/// Finds when each motion first touches an obstacle: the earliest time of an interval at which its solid has a point in common with one,
/// or infinity if there is none. Bodies count as seen from above, and obstacles at all heights.
///
/// The time is never later than the first contact. At that time the solid is away from the obstacle by at most the tolerance, 4 um for each
/// metre of its reach, 2e-14 of the distances to the two ends of a segment together, and the rounding in double, as between two motions.
/// Times are the same bits on every processor, for any number of threads and any split of the batch. A later end of the
/// interval changes no time.
///
/// Units:   as first_contact() of pairs.
/// Sizes:   as many times as motions.
/// Errors:  throws std::invalid_argument, before anything is written, as first_contact() of pairs. Each segment that is near counts as
///          a step.
/// Cost:    for a body at rest, only two cycles of a looping clip are searched.
void first_contact(std::span<const Motion> motions, const ObstacleSet& obstacles,
                   const TimeInterval& interval, std::span<double> times, double tolerance = 0.005);

/// Returns the time until which a motion touches none of the others and no obstacle: the least of what first_contact() finds for both.
/// It is infinity if there is no contact.
/// Errors:  as free_until() without obstacles.
/// Threads: uses one thread; several threads may call it at once.
double free_until(const Motion& motion, std::span<const Motion> others, const ObstacleSet& obstacles,
                  const TimeInterval& interval, double tolerance = 0.005);

}  // namespace bch
