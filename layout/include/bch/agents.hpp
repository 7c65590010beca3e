// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace bch {

/// Names two agents by index. Collisions do not depend on their order; other queries report about the first.
struct Pair {
  std::uint32_t first;
  std::uint32_t second;
  friend bool operator==(const Pair&, const Pair&) = default;
};

/// Views a crowd as a simulator holds it: one entry per agent in each span; nothing is copied.
/// A heading turns a shape about its agent's position. At a heading of 0 the built-in characters face +x, and those of files stand as
/// import.hpp says. A turn of the root within a clip is part of the shape, not of the heading.
/// Units:   metres and radians, counter-clockwise, on the ground plane; |x|, |y|, |z| <= 1e9 m and |heading| <=
///          1e9 rad.
struct Agents {
  std::span<const std::uint32_t> shape;  ///< index into the ShapeSet
  std::span<const double> x;
  std::span<const double> y;
  std::span<const double> heading;
  std::span<const std::uint8_t> level = {};  ///< index into the set's depths; empty: the last level for all
  /// Gives the heights of the grounds that agents stand on: floors, steps, a stage. Empty: one ground for all, and in sets without slices
  /// bodies are then compared whatever their heights. Agents with a z meet only where their heights meet, and the set has to know these
  /// heights (ShapeSetPlan::heights, slices). In sets with slices, agents of equal z are compared slab by slab, others in all pairs of
  /// slabs whose heights meet: slabs of half a metre are then as coarse as those of half as many planes. Even a difference of 1e-12 m
  /// makes neighbouring slabs meet at their common plane, so round z: people on one floor should have equal z.
  std::span<const double> z = {};

  std::size_t size() const noexcept { return shape.size(); }
  /// Returns the index of an agent's root, that of its shape and level, in arrays with level_count entries per shape.
  std::size_t root(std::size_t agent, std::size_t level_count) const noexcept {
    return shape[agent] * level_count + (level.empty() ? level_count - 1 : level[agent]);
  }
};

}  // namespace bch
