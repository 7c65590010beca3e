// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include "baselines/cut_lists.hpp"
#include "baselines/cut_tree.hpp"
#include "baselines/reference.hpp"

namespace bch::baselines {

/// Computes times of impact pair by pair and disc by disc. It is written apart from the kernel, which has to
/// give the same bits.
class TimeOfImpactReference {
 public:
  TimeOfImpactReference(std::span<const Shape> shapes, const ShapeSetPlan& plan)
      : trees_(shapes, plan), cuts_(shapes, plan) {}

  /// Returns the time of impact as time_of_impact() does: the first agent moves by (x, y) relative to the
  /// second. The time is 0 where discs of the cuts overlap at the start. If the displacement is zero in float, it is 0
  /// where the two collide, and infinite elsewhere. `depth_first` visits the child that is met sooner first
  /// and skips what is met later than the first contact so far. Not for two threads at a time.
  float query(const Agents& agents, Pair pair, double x, double y, Method method);

 private:
  CutTrees trees_;
  CutLists cuts_;
  std::vector<OpenPair> open_;
};

}  // namespace bch::baselines
