// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Represents the place of a point of space, in a register.
struct alignas(16) SpaceRow {
  float x, y, z, unused;
};

/// Holds the numbers of two points, which may be the same.
struct PointPair {
  std::uint32_t number[2];
};

/// Holds pairs of points that the same bones move, so that one load of a bone's map serves both. Pairs of equally many bones stand
/// together, so that how many is no surprise.
struct BlendPairs {
  /// Holds pairs of so many bones, up to `end`.
  struct Run {
    std::uint32_t bones, end;
  };
  const Run* runs;
  std::size_t run_count;
  const float* maps;           ///< per bone 3 rows of 4, each twice
  const std::uint32_t* first;  ///< per pair and bone: where the bone's rows begin in `maps`
  const float* weighted;       ///< per pair and bone: x, y, z and 1 of either point, times its weight
  const PointPair* of;         ///< per pair
};

/// Holds the loops of VertexBlend, compiled for one instruction set: write where points go. Return: whether all are finite.
struct BlendLoops {
  bool (*to_space)(const BlendPairs& pairs, SpaceRow* to) noexcept;
  bool (*to_vertices)(const BlendPairs& pairs, Vec3* to) noexcept;
  bool (*to_ground)(const BlendPairs& pairs, Vec2* to) noexcept;  ///< x and y alone, for views from above
};

}  // namespace bch::detail
