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

/// Holds what a primitive (a segment or a triangle) contributes to its node's measure. Axis 0 is x, 1 is y.
struct alignas(32) SplitItem {
  float box[4];   ///< low x, low y, -high x, -high y: boxes are merged by one minimum
  float sums[4];  ///< weight * x, weight * y, weight, 0
};

/// Holds the primitives of a shape in arrays, which may be longer than `count`. Floats suffice, because the side of a
/// plane on which a primitive falls is only a choice, and every processor rounds it alike.
struct SplitItems {
  std::size_t count = 0;
  std::vector<SplitItem> items;
  std::array<std::vector<float>, 2> middle;  ///< per axis: the point that decides a primitive's side
  std::vector<Hierarchy::Primitive> primitives;
  std::vector<std::uint8_t> halvings;  ///< per segment, as EvenHalves::write_halvings() writes them

  /// Removes all primitives and allocates memory for at most `most`.
  void begin(std::size_t most);
  /// Adds a closed contour's segments, four at a time.
  void add_contour(std::span<const Vec2> points, const EvenHalves& halves);
  void add_triangle(const Hierarchy::Primitive& triangle);

 private:
  std::vector<Vec2> ring_;  ///< the points of a contour, then its first ones again
};

}  // namespace bch::detail
