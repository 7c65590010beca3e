// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/hierarchy.hpp>

#include "layout/hierarchy/halves.hpp"

namespace bch::detail {

/// Holds what a primitive, a segment or a triangle, counts for while nodes are divided. Axis 0 is x, 1 is y.
struct alignas(32) SplitItem {
  float box[4];   ///< low x, low y, -high x, -high y: one minimum grows it
  float sums[4];  ///< what it adds to its node's: moments in x and y, weight, 0
};

/// Holds the primitives of a shape, array by array; there is room for more than `count`. In float: which side of a plane an
/// primitive falls on is a choice, not a claim, and every processor rounds it alike.
struct SplitItems {
  std::size_t count = 0;
  std::vector<SplitItem> items;
  std::array<std::vector<float>, 2> middle;  ///< per axis: the point that decides a primitive's side
  std::vector<Hierarchy::Primitive> primitives;
  std::vector<std::uint8_t> halvings;  ///< of segments, as EvenHalves has them

  /// Starts anew, with room for so many.
  void begin(std::size_t most);
  /// Adds a closed contour's segments, four at a time.
  void add_contour(std::span<const Vec2> points, const EvenHalves& halves);
  void add_triangle(const Hierarchy::Primitive& triangle);

 private:
  std::vector<Vec2> ring_;  ///< a contour's points and its first ones again
};

}  // namespace bch::detail
