// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <bch/geometry.hpp>

#include "baselines/exact_tests.hpp"
#include "baselines/obb_tree.hpp"

namespace bch::baselines {

/// Represents an oriented rectangle on the ground: ObbNode without the vertical. Axes are (cosine, sine) and
/// its left normal; the margin in `half` is the same, and the derivation in obb_overlap.hpp covers the test
/// of four axes, which are face normals all.
struct RectangleNode {
  float cosine, sine;
  float centre[2];
  float half[2];       ///< descending
  std::uint32_t link;  ///< as in ObbNode

  bool is_leaf() const noexcept { return (link & ObbNode::leaf_bit) != 0; }
  std::uint32_t facet() const noexcept { return link & ~ObbNode::leaf_bit; }
};
static_assert(sizeof(RectangleNode) == 28);

/// Represents the tree of boxes over an outline, seen from above: box for box the same tree, so that a
/// comparison with it shows what two dimensions are worth in the tests alone.
struct RectangleTree {
  struct Segment {
    Vec2 a, b;
  };
  std::vector<RectangleNode> nodes;
  std::vector<Segment> facets;  ///< in the order of the leaves
  std::uint32_t height = 0;

  /// Builds the tree from an OBB tree over segments at z = 0.
  explicit RectangleTree(const ObbTree& flat);

  std::size_t bytes() const { return nodes.size() * sizeof(RectangleNode) + facets.size() * sizeof(Segment); }
};

/// Represents a rectangle of the second shape in the first shape's frame.
struct PlacedRectangle {
  float cosine, sine;
  float centre[2];
  float half[2];
};

inline PlacedRectangle place(const Placement& placement, const RectangleNode& box) noexcept {
  const float c = static_cast<float>(placement.cosine), s = static_cast<float>(placement.sine);
  return {c * box.cosine - s * box.sine,
          s * box.cosine + c * box.sine,
          {static_cast<float>(placement.x) + (c * box.centre[0] - s * box.centre[1]),
           static_cast<float>(placement.y) + (s * box.centre[0] + c * box.centre[1])},
          {box.half[0], box.half[1]}};
}

/// Returns false only if the rectangles have no point in common.
inline bool boxes_overlap(const RectangleNode& a, const PlacedRectangle& b) noexcept {
  constexpr float rotation_error = 0x1p-18f;  // `parallel` of obb_overlap.hpp
  const float dx = b.centre[0] - a.centre[0], dy = b.centre[1] - a.centre[1];
  const float x = a.cosine * dx + a.sine * dy, y = a.cosine * dy - a.sine * dx;
  const float c = a.cosine * b.cosine + a.sine * b.sine, s = a.cosine * b.sine - a.sine * b.cosine;
  const float size_c = std::abs(c) + rotation_error, size_s = std::abs(s) + rotation_error;
  const float *e = a.half, *f = b.half;
  return !(std::abs(x) > e[0] + (f[0] * size_c + f[1] * size_s) ||
           std::abs(y) > e[1] + (f[0] * size_s + f[1] * size_c) ||
           std::abs(x * c + y * s) > f[0] + (e[0] * size_c + e[1] * size_s) ||
           std::abs(y * c - x * s) > f[1] + (e[0] * size_s + e[1] * size_c));
}

}  // namespace bch::baselines
