// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// Exceeds every length, squared length and time that a kernel computes for valid agents.
constexpr float far_beyond = 0x1p66f;

constexpr float largest_limit = 1e10f;  ///< exceeds the distance of any two agents

constexpr std::uint32_t no_node = 0xffffffff;

/// Holds the nearest features of two agents: two discs, or two segments of their outlines. A is the agent
/// with the lower index.
struct NearestFeatures {
  float distance;  ///< metres
  bool are_segments;
  /// Indices of discs among ShapeSetView::nodes (0 in a set of single discs), or of the first points of
  /// segments; or no_node.
  std::uint32_t a, b;
  // The following members are for discs only.
  float x, y;          ///< vector from A's centre to B's, in A's frame
  float cosine, sine;  ///< A's heading
};

/// Holds the input and output of a clearance kernel. These are plain pointers for the reason that Arguments
/// states.
struct ClearanceArguments {
  Arguments in;              ///< without states; exact_leaves requires trees with segments
  float limit;               ///< distances above it are not searched for; below far_beyond
  float stop_below;          ///< a distance at most that large ends the search, and is reported as -infinity
  NearestFeatures* nearest;  ///< as many as pairs
};

}  // namespace bch::detail
