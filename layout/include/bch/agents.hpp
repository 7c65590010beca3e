// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace bch {

/// Two agents by index. Collisions do not depend on their order; other queries report about the first.
struct Pair {
  std::uint32_t first;
  std::uint32_t second;
  friend bool operator==(const Pair&, const Pair&) = default;
};

/// A crowd as a simulator holds it: one entry an agent in each span; nothing is copied.
/// A heading turns a shape about its agent's position; 0 leaves it as its character was: the built-in ones then face +x,
/// those of files stand as import.hpp says. How a clip turns its character's root stays in the shape.
/// Units:   metres and radians, counter-clockwise, on the ground plane; |x|, |y|, |z| <= 1e9 m and |heading| <=
///          1e9 rad.
struct Agents {
  std::span<const std::uint32_t> shape;  ///< index into the ShapeSet
  std::span<const double> x;
  std::span<const double> y;
  std::span<const double> heading;
  std::span<const std::uint8_t> level = {};  ///< index into the set's depths; empty: the last level for all
  /// Heights of the grounds that agents stand on: floors, steps, a stage. Empty: one ground for all. Agents then meet only where their
  /// heights do, and the set has to know those (ShapeSetPlan::heights, slices). In sets with slices, agents at one height
  /// meet slab by slab; at two heights every two slabs count whose heights meet, and slabs of half a metre are then
  /// as coarse as a cut at half as many planes.
  std::span<const double> z = {};

  std::size_t size() const noexcept { return shape.size(); }
  /// Returns the index of an agent's shape and level in arrays with level_count entries per shape.
  std::size_t root(std::size_t agent, std::size_t level_count) const noexcept {
    return shape[agent] * level_count + (level.empty() ? level_count - 1 : level[agent]);
  }
};

}  // namespace bch
