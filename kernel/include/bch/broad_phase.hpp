// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/shape_set.hpp>

namespace bch {

/// Finds the pairs that a query has to test, and keeps its memory from call to call. An object that was moved from
/// can only be assigned to or destroyed.
class BroadPhase {
 public:
  BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;
  ~BroadPhase();

  /// Returns every pair of agents whose root discs, at the agents' levels, overlap or come within a margin of each other.
  /// Each pair is returned once, with first < second. The result contains every pair that collide() answers with 1, and every
  /// pair for which clearance() returns at most the margin. For time_of_impact() the margin has to be twice the longest
  /// way of an agent. The only other pairs are those whose root discs miss the margin by a few millionths of the margin, of
  /// their radii and of their shapes' reach, or by 2^-26 of the crowd's largest radius.
  /// Units:   metres; the margin is from 0 to 2e9.
  /// Order:   by place, along the rows of a grid, so agents of neighbouring pairs are mostly in cache. The order is the
  ///          same for any number of threads.
  /// Grid:    radii within a factor of four share a grid; other radii have grids of their own, so a few large agents
  ///          do not slow down many small ones. A cell is no smaller than 2^-30 of the crowd's extent.
  /// Memory:  the pairs are valid until the next call. The object keeps 72 bytes an agent and up to 24 a pair; a call
  ///          like an earlier one allocates nothing. `most_pairs` limits that: n agents at one place are n^2 / 2 pairs. (Agents that are
  ///          near each other and at different heights count, too.)
  /// Errors:  throws std::invalid_argument like validate(shapes, agents), and on a margin outside these limits;
  ///          std::length_error as soon as there are more pairs than `most_pairs`.
  /// Threads: runs in the caller's TBB arena; one call at a time. While the calling thread waits for the tasks of the call, it
  ///          takes no other tasks, so one object for each of TBB's threads is enough.
  std::span<const Pair> find(const ShapeSet& shapes, const Agents& agents, double margin = 0,
                             std::size_t most_pairs = std::numeric_limits<std::size_t>::max());

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the pairs of BroadPhase::find() in a new vector, for single calls.
std::vector<Pair> candidate_pairs(const ShapeSet& shapes, const Agents& agents, double margin = 0,
                                  std::size_t most_pairs = std::numeric_limits<std::size_t>::max());

}  // namespace bch
