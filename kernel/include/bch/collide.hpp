// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <bch/query.hpp>

namespace bch {

/// Obstacles that do not move, of <bch/obstacles.hpp>.
class ObstacleSet;

/// Answers each pair: 1 where the two agents collide at their levels, touching included, else 0.
///
/// A collision is never missed. Agents whose outlines meet collide at every level, and those that do not
/// collide at one level do not at a deeper one either. A false positive has a gap
/// of at most the sizes of two discs and 4 um per metre of the two shapes' reaches; between exact leaves, of at most 1.7 um
/// per metre. The answer is the same bits on every
/// processor, for any number of threads, any split of the batch and either order within a pair. Only the
/// difference of positions counts: far from the origin the answer is that of the same placement at the
/// origin.
///
/// Bodies in slabs (ShapeSetPlan::slices) collide where two of their slabs do, solid, whatever `semantics` says: inside a body
/// crossing outlines alone mean nothing. Agents at different heights (Agents::z) collide where parts of them do whose heights
/// meet. Meshes that have a point in common are hits in either case, but for lone triangles that are points on the grid of
/// OutlineBuilder, which outlines leave out.
///
/// Options: semantics, leaves, implementation.
/// Sizes:   hits.size() == pairs.size(); an agent may be paired with itself (it collides).
/// Errors:  throws std::invalid_argument, before hits is touched, on sizes that differ, an index out of
///          range, a position or heading that is not finite or beyond the limits, unknown semantics or leaves, solid
///          semantics on a set that was not planned for it, an implementation that this processor does not
///          run; the message names the agent or pair and the value. Agents that no pair names are not checked.
/// Threads: runs in the caller's TBB arena. The rounding mode, treatment of denormals and traps that threads are set to
///          do not matter to any query, and stay as they are. An exception or cancellation of tasks beside it does not
///          touch it.
void collide(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const QueryOptions& options = {});

/// The neighbours and obstacles that agents collide with, a row an agent, ascending.
struct CrowdCollisions {
  Rows<std::uint32_t> agents, obstacles;
};

/// Finds who of a crowd collides with whom: broad and narrow phase in one call. Keeps its memory from call to call.
/// One that was moved from can only be assigned to or destroyed.
class CrowdCollider {
 public:
  CrowdCollider();
  CrowdCollider(CrowdCollider&&) noexcept;
  CrowdCollider& operator=(CrowdCollider&&) noexcept;
  ~CrowdCollider();

  /// Finds the colliding neighbours of every agent, a row an agent, ascending. j is a neighbour of i exactly if i and j
  /// differ and collide() answers 1 for them; so i is a neighbour of j, too. The answer is the same for any number of
  /// threads and every implementation.
  /// Options: those of collide(), which the broad phase does not need.
  /// Memory:  the answer is valid until the next call. Beside a BroadPhase's, 1 byte for each pair that it
  ///          finds, 8 an agent and 8 a colliding pair are kept; a call like an earlier one allocates
  ///          nothing.
  /// Errors:  throws std::invalid_argument like validate(shapes, agents) and collide(); the last answer is
  ///          then gone.
  /// Threads: runs in the caller's TBB arena; one call at a time, as BroadPhase::find().
  Rows<std::uint32_t> collide_all(const ShapeSet& shapes, const Agents& agents,
                                  const QueryOptions& options = {});

  /// Finds the colliding neighbours of every agent in the same way, and beside them the obstacles, by their numbers, that it collides with. It
  /// has some exactly if collide() with obstacles answers 1.
  /// Memory:  8 bytes for each obstacle of an agent's are kept as well, and a call allocates what collide() with obstacles does.
  CrowdCollisions collide_all(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                              const QueryOptions& options = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Chooses the planes of so many slabs that clear most false collisions of a crowd of given bodies, among those that these are cut
/// at. Bodies stand at random in each other's reach; of two that are seen to collide from above, and in no slab between
/// neighbouring planes, all of whose overlaps a plane has to part. One plane is chosen after the other, and then each again
/// until none is better elsewhere.
/// Sizes:   each body has a slab more than there are planes: PoseShaper makes them with ShapeSetPlan::slices = planes, 5 cm apart
///          for instance; a hundred poses tell enough.
/// Returns: slabs - 1 of the planes, ascending; all of them where there are no more. The same for the same arguments.
/// Errors:  throws std::invalid_argument on no bodies, on no slabs, and as ShapeSet does.
std::vector<float> best_slices(std::span<const Shape> bodies, std::span<const float> planes,
                               std::uint32_t slabs);

}  // namespace bch
