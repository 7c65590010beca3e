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

/// Holds obstacles in arrays of the caller: points, polylines of points, and obstacles of polylines (CSR).
/// A polyline of one point is a post; one without points is ignored.
/// Units:   metres in the world, heights above the same zero as Agents::z; |x|, |y| <= 1e9, heights are
///          numbers or infinite.
struct ObstacleArrays {
  std::span<const double> x, y;  ///< the points of all polylines
  /// Polyline p has points polyline_offsets[p] .. polyline_offsets[p + 1]; one more than polylines.
  std::span<const std::uint64_t> polyline_offsets;
  /// Obstacle o has polylines obstacle_offsets[o] .. obstacle_offsets[o + 1]; empty: one polyline each.
  std::span<const std::uint64_t> obstacle_offsets = {};
  std::span<const std::uint8_t> is_area = {};     ///< per obstacle, see ObstacleSet; empty: no areas
  std::span<const double> bottom = {}, top = {};  ///< per obstacle, heights; empty: infinite
};

/// Selects the meaning of polygons in a file.
enum class Polygons {
  solid,     ///< each polygon is an obstacle: an area
  walkable,  ///< each polygon is a floor for agents, and its rings are walls: lines
};

/// Holds obstacles that do not move: lines, such as walls, and areas, such as pillars and furniture.
/// A line is one or more open polylines. An area is one or more polylines that are closed to rings, and the
/// points that they enclose by the even-odd rule. Obstacles may cross, touch, contain and repeat each other
/// and themselves; only penetration() needs simple polygons. Segments are numbered in the order of the
/// points.
/// Threads: any number of queries may read one set at once. A set that was moved from can only be assigned to
///          or destroyed.
class ObstacleSet {
 public:
  /// Copies the obstacles, and builds a tree of boxes and a grid of distances for them.
  /// Cost:    2 s for 10^6 segments, and 125 bytes for each. Runs in the caller's TBB arena.
  /// Errors:  throws std::invalid_argument on sizes that differ, on offsets that descend or leave their
  ///          array, on a point that is not finite or beyond the limits, and on an obstacle whose bottom is
  ///          above its top. The message names the point or obstacle. Throws std::length_error beyond 2^31
  ///          points, polylines or obstacles.
  explicit ObstacleSet(const ObstacleArrays& obstacles);
  ObstacleSet(ObstacleSet&&) noexcept;
  ObstacleSet& operator=(ObstacleSet&&) noexcept;
  ~ObstacleSet();

  std::uint32_t obstacle_count() const noexcept;
  std::uint32_t segment_count() const noexcept;
  /// Returns the obstacle that a segment belongs to.
  /// Errors:  throws std::out_of_range on an index out of range.
  std::uint32_t obstacle_of(std::uint32_t segment) const;

  // Internal, for the library's own code; the type is not public.
  /// Returns the arrays that queries read.
  const detail::ObstacleView& view() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads obstacles from well-known text, as JuPedSim and geographic information systems write it.
/// Each line and each solid polygon is one obstacle; of walkable polygons each ring is one. All extend from
/// `bottom` to `top`. "Obstacles" in kernel/README.md lists what is read and what is ignored.
/// Errors:  throws std::invalid_argument on malformed text, with the line, the column in bytes, what was
///          found and what was expected; and as ObstacleSet does.
ObstacleSet obstacles_from_wkt(std::string_view text, Polygons polygons = Polygons::solid,
                               double bottom = -std::numeric_limits<double>::infinity(),
                               double top = std::numeric_limits<double>::infinity());

// Queries of agents against obstacles. Each answers for every agent what the query of the same name answers
// for every pair. A body is compared only with obstacles whose heights meet its own (see Agents::z);
// ShapeSetPlan::heights gives shapes heights. "Obstacles" in kernel/accuracy.md bounds the errors.
// Sizes:   one answer per agent.
// Errors:  throw std::invalid_argument, before anything is written, as validate(shapes, agents) and the query
//          of pairs.
// Threads: run in the caller's TBB arena; each task allocates memory for the segments near 64 agents.

/// Tests whether each agent collides with an obstacle: writes 1 for a hit and 0 otherwise.
/// An agent collides if a disc of its cut and all ancestors of that disc overlap the obstacle, touching
/// included. With exact leaves the outline in that disc has to overlap it, too. An agent inside an area
/// always collides, and so does one whose outline contains a whole polyline of an obstacle.
void collide(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const CollideOptions& options = {});

/// Tests whether each agent comes within a distance of an obstacle: writes 1 if so and 0 otherwise.
/// There is one distance for all agents, or one each. The answer is 1 where clearance(), with the same leaves
/// and no limit, is at most the distance; but clearance() is rounded to float, so the two may differ by that
/// rounding.
void within(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers, Leaves leaves = Leaves::discs,
            const Implementation* implementation = nullptr);

// Queries of bodies of spheres. An obstacle is an upright solid, from its bottom to its top, on its line or
// over its area. A sphere touches it if the distance from its centre to the solid is at most its radius. If
// the mesh in a body meets an obstacle, the answer is a hit. Sizes, errors and threads are as above.

/// Tests whether some sphere of each agent touches an obstacle: writes 1 for a hit and 0 otherwise.
void collide(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
             std::span<std::uint8_t> hits, const Implementation* implementation = nullptr);

/// Tests whether some sphere of each agent comes within a distance of an obstacle.
/// Writes 1 if so and 0 otherwise. There is one distance for all agents, or one each, in metres.
void within(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
            std::span<const double> distances, std::span<std::uint8_t> answers,
            const Implementation* implementation = nullptr);

/// Measures how far each agent is in space from the nearest obstacle.
/// That is the least gap between a sphere and an obstacle; with Overlap::zero it is 0 exactly where collide()
/// answers 1. The direction leads from the agent to the obstacle. `spheres` holds the index of the sphere and
/// that of the segment, which is 2^32 - 1 if the sphere is above, in or below an area. Points are relative to
/// the agent's position. If gaps are equal, the first obstacle is chosen.
void clearance(const BodySet& bodies, const Agents& agents, const ObstacleSet& obstacles,
               const BodyClearanceAnswers& answers, const BodyClearanceOptions& options = {});

/// Measures how far each agent is from the nearest obstacle.
/// That is the least gap between a disc of its cut and a segment of an obstacle. With Leaves::segments, its
/// outline replaces the discs. The gap is 0 if the two overlap, if a disc is inside an area, or if a whole
/// polyline is inside the agent's outline. The direction leads from the agent to the obstacle; `discs` has
/// the agent's disc and the number of the segment; `points` are relative to the agent's position. "Obstacles"
/// in kernel/accuracy.md has Overlap::deepest, ties and errors.
void clearance(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
               const ClearanceAnswers& answers, const ClearanceOptions& options = {});

/// Measures how far each agent has to move to leave an obstacle, and in which direction.
/// The move is perpendicular to one segment. One move takes an agent out of a convex area or off a single
/// segment; for other obstacles, call again after the move. The depth is 0, and the direction (0, 0), where
/// nothing is touched. "Obstacles" in kernel/accuracy.md has the rules.
/// Cost:    n log n steps. n is the number of segments near the agent. If its move crosses segments farther
///          away, n counts all segments up to the farthest of these.
void penetration(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                 std::span<Penetration> out, const Implementation* implementation = nullptr);

/// Measures how far each agent has to move on the ground to be free of all neighbours and obstacles at once.
/// Only this agent moves. `neighbours` has a pair for each agent and each other that its move may come near.
/// Neither the order of the pairs nor that within a pair matters. `obstacles` may be null. If nothing else
/// moves, collide() with each of them then answers 0. An agent that collides with nothing has a depth of 0.
/// Directions and touches (Penetration::Touch) are as in nearest_free() of pairs. With obstacles, depths
/// include 30 um per metre of the move and of the extent.
/// Sizes:   one answer per agent; as many touches or none. Errors: also as nearest_free() of pairs.
/// Memory:  allocates in every call.
void nearest_free(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> neighbours,
                  const ObstacleSet* obstacles, std::uint32_t directions, std::span<Penetration> out,
                  const CollideOptions& options = {}, std::span<Penetration::Touch> touches = {});
/// Measures the same for bodies of spheres.
void nearest_free(const BodySet& bodies, const Agents& agents, std::span<const Pair> neighbours,
                  const ObstacleSet* obstacles, std::uint32_t directions, std::span<Penetration> out,
                  const Implementation* implementation = nullptr, std::span<Penetration::Touch> touches = {});

/// Finds when each agent first touches an obstacle while it moves by its displacement without turning.
/// The time is the least t in [0, 1] at which a disc of the agent's cut overlaps an obstacle, or infinity if
/// there is none. It is 0 inside an area, and if the agent's outline contains a whole polyline.
void time_of_impact(const ShapeSet& shapes, const Agents& agents, const Displacements& displacements,
                    const ObstacleSet& obstacles, std::span<float> times,
                    const Implementation* implementation = nullptr);

/// Finds when each motion first touches an obstacle, or infinity if it does not within the interval.
/// Bodies are compared as seen from above, and heights of obstacles are ignored. The time is never late;
/// "Motions" in kernel/accuracy.md says how early it may be. If a body stands still, only two cycles of its
/// looping clip are searched.
/// Sizes:   as many times as motions. Units: as first_contact() of pairs.
/// Errors:  throws std::invalid_argument, before anything is written, as first_contact() of pairs. That query
///          ends after 1e8 steps (motion.hpp); here each near segment counts as a step, too.
void first_contact(std::span<const Motion> motions, const ObstacleSet& obstacles,
                   const TimeInterval& interval, std::span<double> times, double tolerance = 0.005);

/// Returns the time until which a motion touches none of the others and no obstacle, or infinity.
/// It is the least time that first_contact() finds for the other motions and for the obstacles.
/// Errors:  as free_until() without obstacles.
/// Threads: uses one thread; several threads may call it at once.
double free_until(const Motion& motion, std::span<const Motion> others, const ObstacleSet& obstacles,
                  const TimeInterval& interval, double tolerance = 0.005);

}  // namespace bch
