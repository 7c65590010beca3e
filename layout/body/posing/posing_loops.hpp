// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

/// Corners of a sphere that are measured side by side.
constexpr std::uint32_t corner_block = 8;

/// Holds spheres and their corners, as numbers of points, which have four floats each; the last corner of a sphere is repeated until its last block is full.
struct SphereCorners {
  std::uint32_t spheres;
  const float* points;
  const float* centres;  ///< points, one a sphere
  const std::uint32_t* corners;
  const std::uint32_t* end;  ///< by sphere, of its corners
};

/// Holds spheres side by side, filled up to whole registers.
struct SphereFields {
  float *x, *y, *z, *radius;
};

/// Holds the loops of posing, compiled for one instruction set.
struct PosingLoops {
  /// Takes the centres, and sets each radius to the square of the distance of the sphere's farthest corner.
  void (*measure)(const SphereCorners& corners, const SphereFields& to) noexcept;
  /// Replaces squares by their roots, at least `least`, enlarged by this fraction of themselves. Returns: the extent of the spheres.
  float (*take_roots)(const SphereFields& of, std::uint32_t count, const float* least, float scale) noexcept;
};

}  // namespace bch::detail
