// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/hierarchy.hpp>
#include <bch/shapes.hpp>

#include "baselines/cut_lists.hpp"
#include "baselines/leaf_segments.hpp"

namespace bch::baselines {

enum class Method {
  brute_force,  ///< every disc of one cut against every one of the other, with all ancestors: the definition
  depth_first,  ///< the paper's descent into the larger disc, which verifies what it finds
};

/// Answers the questions of the batch kernel straight from the binary hierarchies: one pair at a time, one
/// disc test at a time, in float with the operations that layout/base/rounding.hpp lists. Slow, obvious, and
/// written apart from the kernel, which has to give the same bits.
class Reference {
 public:
  /// Takes shapes and a plan as a ShapeSet does. The shapes must outlive this.
  Reference(std::span<const Shape> shapes, const ShapeSetPlan& plan, Leaves leaves = Leaves::segments);

  /// Returns the answer of the paper, whether outlines cross: discs of the cuts of agents a and b overlap with
  /// all their ancestors; with exact leaves, their segments have to meet as well.
  bool boundary(const Agents& agents, Pair pair, Method method) const;

  /// Returns whether boundary() holds or, where the plan keeps outlines, an outline contains a contour of the
  /// other one: what collide() answers. The containment test is in long double, for outlines that do not meet.
  bool solid(const Agents& agents, Pair pair, Method method) const;

 private:
  bool compare_all(const Agents& agents, Pair pair) const;
  bool descend(const Agents& agents, Pair pair) const;

  std::span<const Shape> shapes_;
  std::vector<std::uint32_t> depths_;
  bool has_outlines_;
  std::vector<std::uint32_t> heights_;  ///< per shape
  CutLists cuts_;
  LeafSegments segments_;
};

}  // namespace bch::baselines
