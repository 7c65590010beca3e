// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/shapes.hpp>

#include "baselines/cut_lists.hpp"
#include "baselines/leaf_segments.hpp"

namespace bch::baselines {

/// Represents an obstacle as a list of segments, ax, ay, bx and by each, and whether these enclose what
/// belongs to it.
struct ReferenceObstacle {
  std::vector<std::array<double, 4>> segments;
  bool is_area = false;
};

/// Answers queries by brute force over all discs and all segments, by the definitions in <bch/obstacles.hpp>.
class ObstacleReference {
 public:
  /// Takes shapes and a plan as a ShapeSet does. The shapes must outlive this.
  ObstacleReference(std::span<const Shape> shapes, const ShapeSetPlan& plan, Leaves leaves)
      : shapes_(shapes), cuts_(shapes, plan), segments_(shapes, plan, leaves) {}

  bool collides(const Agents& agents, std::uint32_t agent, const ReferenceObstacle& obstacle) const;
  /// Returns whether the agent's outline holds a point of the obstacle.
  bool outline_contains(const Agents& agents, std::uint32_t agent, const ReferenceObstacle& obstacle) const;

  /// Holds the least gap, and of equal ones that of the first disc, then of the first segment, numbered
  /// through all obstacles.
  struct Gap {
    double gap;
    std::uint32_t disc, segment;
    std::uint32_t of_outline =
        none;  ///< in place of a disc: the number of the nearest segment of the outline
  };
  static constexpr std::uint32_t none = 0xffffffff;
  Gap gap(const Agents& agents, std::uint32_t agent, std::span<const ReferenceObstacle> obstacles) const;
  /// Returns that of an agent's outline where segments decide: of equal ones its first segment, any before discs of leaves with too many.
  Gap outline_gap(const Agents& agents, std::uint32_t agent,
                  std::span<const ReferenceObstacle> obstacles) const;

  /// Returns whether an area holds the centre of a disc of the cut.
  bool contains_a_centre(const Agents& agents, std::uint32_t agent, const ReferenceObstacle& obstacle) const;
  /// Returns whether an area holds something of the agent's outline where segments decide.
  bool contains_the_outline(const Agents& agents, std::uint32_t agent,
                            const ReferenceObstacle& obstacle) const;

 private:
  std::span<const Shape> shapes_;
  CutLists cuts_;
  LeafSegments segments_;
};

}  // namespace bch::baselines
