// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/disc.hpp"

namespace bch {

/// Discs of a block.
constexpr std::uint32_t block_width = 8;
/// Longest way, in blocks, from a root block to a leaf; what kernels size their stacks by.
constexpr std::uint32_t most_wide_levels = 16;

/// Directions of supports, and the floats that a set's supports take; see supports.hpp.
constexpr std::uint32_t support_directions = 16;
constexpr std::uint32_t support_stride = 2 * support_directions + 1;

/// Floats that the farthest points along those directions take; see interior.hpp.
constexpr std::uint32_t extreme_stride = 2 * support_directions;

/// The nodes of all shapes and levels as plain pointers: what kernels read. Valid while the set lives.
/// Roots:   index shape * level_count + level.
/// Blocks:  block b's discs are x, y, radius[8 b .. 8 b + 7]; see WideBlock.
/// Contours: shape s has contours shape_contours[s] .. shape_contours[s + 1]; contour c has points
///          contour_points[c] .. contour_points[c + 1]. Null without the solid plan.
struct ShapeSetView {
  std::uint32_t shape_count;
  std::uint32_t level_count;

  const float* root_x;
  const float* root_y;
  const float* root_radius;
  const std::uint32_t* root_block;     ///< global block index
  const std::uint8_t* root_is_single;  ///< the cut is the root disc alone
  const float* support;                ///< support_stride floats a root; null without the plan's shortcuts

  const float* x;
  const float* y;
  const float* radius;
  const std::uint32_t* first_child;  ///< global block index
  const std::uint8_t* inner_count;

  const float* reach;  ///< per shape, metres, rounded up

  // Per shape; see interior.hpp. Null without the plan's shortcuts.
  const float* inscribed_x;  ///< block_width a shape, like the next two
  const float* inscribed_y;
  const float* inscribed_radius;
  const float* extreme_x;  ///< extreme_stride a shape, like the next
  const float* extreme_y;

  const std::uint32_t* shape_contours;
  const std::uint32_t* contour_points;
  const Disc* contour_disc;  ///< smallest enclosing disc of a contour
  const Vec2* points;
};

}  // namespace bch
