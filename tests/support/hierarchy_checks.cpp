// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/hierarchy_checks.hpp"

#include <gtest/gtest.h>

#include "layout/base/rounding.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/hierarchy/subtrees.hpp"

namespace bch::test {
namespace {

double distance(const Disc& disc, double x, double y) {
  return std::hypot(static_cast<double>(disc.x) - x, static_cast<double>(disc.y) - y);
}

void expect_contains_primitives(const Hierarchy& hierarchy, std::uint32_t node) {
  const Disc& disc = hierarchy.nodes[node].disc;
  for (std::uint32_t e = hierarchy.primitive_ranges[node].begin; e < hierarchy.primitive_ranges[node].end;
       ++e) {
    const auto [a, b, c] = hierarchy.primitives[e];
    for (const Vec2& p : {a, b, c}) ASSERT_LE(distance(disc, p.x, p.y), disc.radius) << "primitive " << e;
  }
}

}  // namespace

void expect_sound(const Hierarchy& hierarchy) {
  const auto& nodes = hierarchy.nodes;
  ASSERT_FALSE(nodes.empty());
  const auto& held = hierarchy.primitive_ranges;
  ASSERT_EQ(held.size(), nodes.size());
  EXPECT_EQ(held[0].end, hierarchy.primitives.size());
  const std::vector<float> bounds = detail::bounding_radii(hierarchy);
  const std::vector<std::uint32_t> ends = detail::subtree_ends(nodes);
  EXPECT_EQ(ends[0], nodes.size());
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const Hierarchy::Node& node = nodes[i];
    ASSERT_LT(held[i].begin, held[i].end) << "node " << i;
    expect_contains_primitives(hierarchy, i);
    double needed = node.disc.radius;
    for (std::uint32_t below = i + 1; below < ends[i]; ++below) {
      const Disc& disc = nodes[below].disc;
      needed = std::max(needed, distance(node.disc, disc.x, disc.y) + static_cast<double>(disc.radius));
    }
    ASSERT_GE(bounds[i], needed) << "node " << i;
    ASSERT_LE(bounds[i], needed * (1 + 0x1p-22)) << "node " << i;
    if (node.is_leaf()) continue;
    EXPECT_EQ(held[i + 1].begin, held[i].begin);
    EXPECT_EQ(held[i + 1].end, held[node.second_child].begin);
    EXPECT_EQ(held[node.second_child].end, held[i].end);
  }
}

void expect_covers_outline(const Hierarchy& hierarchy, const Outline& outline) {
  // Where each segment's pieces start, in the order of their halving.
  std::vector<Vec2> reached(outline.points);
  std::vector<std::vector<Hierarchy::Primitive>> pieces(outline.points.size());
  for (std::size_t e = 0; e < hierarchy.primitives.size(); ++e)
    pieces[hierarchy.source[e]].push_back(hierarchy.primitives[e]);
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      Vec2 at = contour[i];
      for (const Hierarchy::Primitive& piece : pieces[outline.contour_begin[c] + i]) {
        EXPECT_EQ(piece.a, at);
        at = piece.b;
      }
      EXPECT_EQ(at, contour[(i + 1) % contour.size()]) << "segment " << i << " of contour " << c;
    }
  }
  for (std::uint32_t depth = 0; depth <= detail::height(hierarchy); ++depth) {
    std::uint32_t next = 0;
    for (const std::uint32_t node : cut(hierarchy, depth)) {
      ASSERT_EQ(hierarchy.primitive_ranges[node].begin, next) << "depth " << depth;
      next = hierarchy.primitive_ranges[node].end;
    }
    ASSERT_EQ(next, hierarchy.primitives.size()) << "depth " << depth;
  }
}

void expect_leaves_below(const Hierarchy& hierarchy, float threshold) {
  for (const Hierarchy::Node& node : hierarchy.nodes)
    if (node.is_leaf()) {
      EXPECT_LE(node.disc.radius, static_cast<double>(threshold) * (1 + 1e-6) + 4e-6 * hierarchy.max_extent);
    }
}

}  // namespace bch::test
