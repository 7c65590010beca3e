// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/agents.hpp"
#include "layout/hierarchy.hpp"
#include "layout/shape_set.hpp"

namespace bch::baselines {

enum class Method {
  brute_force,  ///< every disc of one cut against every disc of the other: the definition of the answer
  depth_first,  ///< a traversal of both binary trees that descends into the larger disc
};

/// Scalar answers to the questions of the batch kernel, straight from the binary hierarchies: one pair at a
/// time, one disc test at a time, in float with the operations that layout/rounding.hpp lists. Slow, obvious,
/// and written apart from the kernel, which has to give the same bits.
class Reference {
 public:
  /// Shapes and levels as in ShapeSet. The shapes must outlive this.
  Reference(std::span<const Shape> shapes, const ShapeSetPlan& plan);

  /// Whether discs of the cuts of agents a and b overlap.
  bool boundary(const Agents& agents, Pair pair, Method method) const;

  /// The same, or an outline contains a contour of the other. Long double; for outlines that do not meet.
  bool solid(const Agents& agents, Pair pair, Method method) const;

 private:
  struct Level {
    std::uint32_t depth;
    std::uint32_t height;  ///< of the whole hierarchy
    std::vector<Disc> discs;
  };
  const Level& level(const Agents& agents, std::uint32_t agent) const;

  std::span<const Shape> shapes_;
  std::uint32_t level_count_;
  std::vector<std::vector<float>> bounds_;  ///< per shape: bounding_radii()
  std::vector<Level> levels_;               ///< shape * level_count_ + level
};

}  // namespace bch::baselines
