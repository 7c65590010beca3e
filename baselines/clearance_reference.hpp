// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baselines/cut_tree.hpp"
#include "baselines/reference.hpp"

namespace bch::baselines {

/// Holds the answer of clearance() for a pair.
struct Clearance {
  float distance;  ///< metres; infinite beyond the limit, and the rest is as clearance() says
  Vec2 direction;
  std::uint32_t first, second;  ///< of the cuts
};

/// Returns what clearance() says with Overlap::zero of a pair that has such an answer.
Clearance at_least_zero(const Clearance& clearance);

/// Computes clearances with Overlap::deepest, pair by pair and disc by disc. It is written apart from the kernel, which has to give
/// the same bits.
class ClearanceReference {
 public:
  ClearanceReference(std::span<const Shape> shapes, const ShapeSetPlan& plan) : trees_(shapes, plan) {}

  /// Returns the clearance of a pair. `depth_first` visits the nearer child first and skips what is farther
  /// than the nearest so far. Not for two threads at a time.
  Clearance query(const Agents& agents, Pair pair, double max_distance, Method method);

  /// Returns what within() says of a pair of which neither outline holds the other.
  bool within(const Agents& agents, Pair pair, double distance, Method method);

 private:
  CutTrees trees_;
  std::vector<OpenPair> open_;
};

}  // namespace bch::baselines
