// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/shape_set.hpp>

#include "baselines/reference.hpp"

namespace bch::baselines {

/// Answers queries about bodies in slabs, or whole ones at different heights, pair by pair of parts, straight from the definition.
class SlabBodies {
 public:
  /// Takes shapes and a plan as a ShapeSet does; an empty list of slices means whole bodies.
  SlabBodies(std::span<const Shape> shapes, const ShapeSetPlan& plan, Leaves leaves = Leaves::segments);

  /// Represents two agents by a part of each: the pair (0, 1) of a crowd of two, in the order of the pair that was
  /// asked about.
  struct PartPair {
    std::uint32_t shape[2];  ///< parts
    std::uint32_t slab[2];
    double x[2], y[2], heading[2];
    std::uint8_t level[2];

    Agents agents() const { return {shape, x, y, heading, level}; }
  };
  /// Returns all pairs of parts that may meet: those of the same slab where both agents stand at the same height, else all; and
  /// their heights meet. Ordered by slabs of the first agent.
  std::vector<PartPair> part_pairs(const Agents& agents, Pair pair) const;

  /// Returns whether some of these collide, as Reference::solid() says.
  bool collide(const Agents& agents, Pair pair, Method method) const;

  std::span<const Shape> parts() const { return parts_; }

 private:
  std::size_t slabs_;
  std::size_t levels_;
  std::vector<Shape> parts_;
  std::vector<Heights> heights_;                    ///< of each part
  std::vector<std::optional<std::uint32_t>> part_;  ///< of shape * slabs + slab
  std::optional<Reference> reference_;
};

}  // namespace bch::baselines
