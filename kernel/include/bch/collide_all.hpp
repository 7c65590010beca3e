// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>

#include <bch/query.hpp>

namespace bch {

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

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
