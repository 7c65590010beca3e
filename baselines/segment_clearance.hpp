// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/shapes.hpp>

#include "baselines/cut_lists.hpp"
#include "baselines/leaf_segments.hpp"

namespace bch::baselines {

/// Computes the distances of clearance() with exact leaves, all segments against all. It is written apart from the kernel, which has to give
/// the same bits.
class SegmentClearance {
 public:
  /// Takes shapes and a plan as a ShapeSet does. The shapes must outlive this.
  SegmentClearance(std::span<const Shape> shapes, const ShapeSetPlan& plan);

  /// Names two segments by their numbers in the outlines, that of the agent with the lower index first; of discs
  /// none.
  struct Nearest {
    float distance;  ///< metres
    std::uint32_t a, b;
  };
  static constexpr std::uint32_t none = 0xffffffff;

  /// Returns what is nearest, in a tie the first; nothing where segments do not decide.
  std::optional<Nearest> nearest(const Agents& agents, Pair pair) const;
  /// Returns the distance in metres, infinite beyond the limit; nothing where segments do not decide.
  std::optional<float> distance(const Agents& agents, Pair pair, double max_distance) const;

 private:
  /// Holds what the leaves of a shape hold.
  struct Leaves {
    std::vector<std::uint32_t> segments;  ///< of all leaves that do not have too many
    std::vector<std::uint32_t> coarse;    ///< leaves that have
  };
  Nearest least_gap(const FloatPlacement& place, const Agents& agents, Pair in_order) const;

  std::span<const Shape> shapes_;
  CutLists cuts_;
  LeafSegments segments_;
  std::vector<Leaves> leaves_;  ///< per shape
};

}  // namespace bch::baselines
