// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/arguments.hpp"

namespace bch::detail {

/// A number beyond every length, squared length and time that a kernel computes of valid agents.
constexpr float far_beyond = 0x1p66f;

constexpr float largest_limit = 1e10f;  ///< beyond the distance of any two agents

constexpr std::uint32_t no_node = 0xffffffff;

/// Holds what is nearest to each other of two agents: two discs, or two segments of their outlines. The agent with the lower index is A.
struct NearestFeatures {
  float distance;  ///< metres
  bool are_segments;
  /// The places of the discs among ShapeSetView::nodes, 0 in a set of roots alone; or the points where the segments begin; or no_node.
  std::uint32_t a, b;
  // Discs alone have the following.
  float x, y;          ///< vector from A's centre to B's, in A's frame
  float cosine, sine;  ///< A's heading
};

/// Holds the input and output of a clearance kernel. These are plain pointers for the reason that Arguments states.
struct ClearanceArguments {
  Arguments in;              ///< without states; with exact_leaves, of which trees have segments
  float limit;               ///< distances above it are not searched for; below far_beyond
  float stop_below;          ///< one at or below it ends a search of trees, and is then given as -infinity
  NearestFeatures* nearest;  ///< as many as pairs
};

}  // namespace bch::detail
