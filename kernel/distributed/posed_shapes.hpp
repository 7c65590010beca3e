// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include <bch/distributed_crowd.hpp>
#include <bch/shapes.hpp>

#include "kernel/baking/pose_baker.hpp"

namespace bch::detail {

/// Holds the shapes of a rank's agents and of the copies of others', one each, made of their poses on all threads. A set is built anew in
/// the memory of the last one: how many agents a rank has changes from step to step.
class PosedShapes {
 public:
  /// Takes valid characters, which must outlive this.
  /// Errors:  throws std::invalid_argument on a bad plan.
  PosedShapes(std::span<const Character> characters, const ShapeSetPlan& plan);

  /// Takes all shapes away.
  void clear();
  /// Adds the shapes of agents, in their order.
  /// Precondition: their characters and poses are there.
  void add(std::span<const DistributedCrowd::Agent> agents);
  /// Returns, for each character, the radius about an agent that holds all of its shapes; 0 where it has none. `agents`: those that
  /// were added first.
  std::vector<double> radii(std::span<const DistributedCrowd::Agent> agents) const;
  const ShapeSet& set() const { return *set_; }
  const ShapeSetPlan& plan() const { return plan_; }
  std::span<const Character> characters() const { return characters_; }

 private:
  std::span<const Character> characters_;
  ShapeSetPlan plan_;
  PoseBaker baker_;
  ShapeSetBuilder builder_;
  const ShapeSet* set_;  ///< the builder's
};

/// Returns agents of every character in poses from all of its clips, which say how far its poses reach.
std::vector<DistributedCrowd::Agent> sampled_agents(std::span<const Character> characters);

}  // namespace bch::detail
