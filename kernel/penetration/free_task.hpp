// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

// What searches of free places read and write, in plain arrays.

namespace bch::detail {

/// Holds a sphere; a disc, whose z is 0; or a segment of an outline or of a wall: the disc about it, half of the way along it, and of a wall
/// half of its height.
struct FreeElement {
  float x, y, z, radius;
  float half_x = 0, half_y = 0, half_z = 0;
};

/// The most floats that a register has.
constexpr std::uint32_t most_lanes = 16;

/// Bounds places by the intervals of some spheres, or discs.
struct FreeBound {
  static constexpr std::uint32_t capacity = 64;

  std::uint32_t count = 0;
  /// Centres of B's as seen from A's, and the square of the distance on the ground within which they overlap, or -1.
  alignas(64) float x[capacity] = {}, y[capacity] = {}, left[capacity] = {};
};

/// Holds elements, or nodes as seen from above, and where they are along a direction and across it. Behind them there is room for a register.
struct FreeColumns {
  float *x, *y, *z, *radius, *half_x, *half_y, *half_z, *along, *across, *half_along, *half_across, *slope;
};

/// Holds a body's elements and nodes.
struct FreeLeaves {
  FreeColumns elements;
  FreeColumns nodes;  ///< of the leaves, and behind them that of the whole; z is their bottom
  float* top;
  std::uint32_t leaves, leaf_size;
  [[gnu::always_inline]] std::uint32_t first(std::uint32_t leaf) const noexcept { return leaf * leaf_size; }
};

/// Selects what overlaps.
enum class FreeKind : std::uint8_t { spheres, segments, walls };

/// Is the search of a pair. Nodes come within the slack of each other where elements come within the margin.
struct FreeTask {
  FreeLeaves a, b;
  float margin, node_slack;
  FreeKind kind;
  std::uint16_t *leaves_a, *leaves_b, *slots;  ///< room for lists
};

}  // namespace bch::detail
