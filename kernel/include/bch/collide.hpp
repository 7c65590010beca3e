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
/// A collision is never missed: agents whose outlines meet collide at every level, and those that do not
/// collide at one level do not at a deeper one either. A false positive has a gap of at most the sizes of two
/// discs and 4 um per metre of the two shapes' reaches; between exact leaves, of at most 1.7 um per metre. The
/// answer is the same bits on every processor, for any number of threads, any split of the batch and either
/// order within a pair. Only the difference of positions counts, so answers far from the origin are those at
/// the origin.
///
/// Bodies in slabs (ShapeSetPlan::slices) collide where two of their slabs do, always in solid semantics: a limb can lie inside a
/// torso without their outlines crossing. Agents at different heights (Agents::z) collide where parts of them do whose heights
/// meet. In either case meshes that have a point in common are hits, except at lone triangles that are points on the grid of
/// OutlineBuilder, which outlines leave out.
///
/// Options: semantics, leaves, implementation.
/// Sizes:   hits.size() == pairs.size(); an agent may be paired with itself (it collides).
/// Errors:  throws std::invalid_argument, before hits is touched, on sizes that differ, an index out of
///          range, a position or heading that is not finite or beyond the limits, unknown semantics or leaves, solid
///          semantics on a set that was not planned for it, an implementation that this processor does not
///          run; the message names the agent or pair and the value. Agents that no pair names are not checked.
/// Threads: runs in the caller's TBB arena, isolated from the cancellation of the caller's task group. Rounding mode, treatment
///          of denormals and traps of the threads do not matter to any query, and stay as they are.
void collide(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const QueryOptions& options = {});

/// The neighbours and obstacles that agents collide with, a row an agent, ascending.
struct CrowdCollisions {
  Rows<std::uint32_t> agents, obstacles;
};

/// Finds all collisions of a crowd: broad and narrow phase in one call. Keeps its memory from call to call.
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

  /// Finds the colliding neighbours of every agent, as above, and the numbers of the obstacles that it collides with: none exactly
  /// where collide() with obstacles answers 0.
  /// Memory:  8 bytes for each obstacle of an agent's are kept as well, and a call allocates what collide() with obstacles does.
  CrowdCollisions collide_all(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                              const QueryOptions& options = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Chooses, among `planes`, those that clear most false collisions of given bodies when they cut them into so many slabs.
/// The sample is random pairs of bodies in each other's reach which collide as seen from above, but in no slab between
/// neighbouring planes. Chosen planes clear a pair if each two of its overlapping slabs have one between them. The search is greedy:
/// one plane after the other, then each anew until no exchange clears more.
/// Sizes:   each body has a slab more than there are planes: PoseShaper makes them with ShapeSetPlan::slices = planes, 5 cm apart
///          for instance; a hundred poses tell enough.
/// Returns: slabs - 1 of the planes, ascending; all of them where there are no more. The same for the same arguments.
/// Errors:  throws std::invalid_argument on no bodies, on no slabs, and as ShapeSet does.
std::vector<float> best_slices(std::span<const Shape> bodies, std::span<const float> planes,
                               std::uint32_t slabs);

}  // namespace bch
