// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include <bch/shape_set.hpp>
#include <bch/shape_set_builder.hpp>

#include "layout/hierarchy/subtrees.hpp"
#include "layout/shape_set/bvh8.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/scenes.hpp"

namespace bch {
namespace {

/// Walks a wide tree: its height in blocks and windows, and the discs that it reaches, which are those of a window
/// below all nodes of the blocks above it (a window may show neighbours of its group as well).
class Walk {
 public:
  explicit Walk(const detail::Bvh8& tree) : tree_(tree), reached_(tree.count) {
    visit(tree.top, {}, 1);
    for (std::size_t i = 0; i < reached_.size(); ++i)
      if (reached_[i]) discs.push_back(disc(detail::leaf_window + static_cast<std::uint32_t>(i)));
  }
  std::vector<Disc> discs;
  std::uint32_t levels = 0;

 private:
  /// Of an inner node, or leaf_window + a cut disc's index.
  Disc disc(std::uint32_t node) const {
    const std::uint32_t i = node & ~detail::leaf_window;
    if (node >= detail::leaf_window) return {tree_.x[i], tree_.y[i], tree_.radius[i]};
    return {tree_.inner[i].x, tree_.inner[i].y, tree_.inner[i].radius};
  }

  std::uint32_t above(std::uint32_t inner) const { return tree_.inner[inner].link & ~detail::above_cut_disc; }

  bool is_above(std::uint32_t node, std::uint32_t i) const {
    if (node >= detail::leaf_window) return node == detail::leaf_window + i;
    std::uint32_t at = tree_.inner[i].link >= detail::above_cut_disc ? i : i - 1;
    while (at != node && at != above(at)) at = above(at);
    return at == node;
  }

  void visit(std::uint32_t node, const std::vector<std::uint32_t>& nodes_above, std::uint32_t level) {
    levels = std::max(levels, level);
    if (node & detail::leaf_window) return reach(node & ~detail::leaf_window, nodes_above);
    const detail::Bvh8::Block& block = tree_.blocks.at(node);
    for (std::uint32_t lane = 0; lane < detail::block_width; ++lane) {
      const Disc in_block{block.discs.x[lane], block.discs.y[lane], block.discs.radius[lane]};
      if (std::isinf(in_block.x)) {
        EXPECT_EQ(in_block.radius, 0);
        continue;
      }
      EXPECT_EQ(in_block, disc(block.node[lane]));
      std::vector<std::uint32_t> way = nodes_above;
      way.push_back(block.node[lane]);
      visit(block.child[lane], way, level + 1);
    }
  }

  void reach(std::uint32_t first, const std::vector<std::uint32_t>& nodes_above) {
    ASSERT_LE(first + detail::block_width, tree_.x.size());
    for (std::uint32_t i = first; i < std::min(first + detail::block_width, tree_.count); ++i)
      if (std::all_of(nodes_above.begin(), nodes_above.end(),
                      [&](std::uint32_t node) { return is_above(node, i); }))
        reached_[i] = true;
  }

  const detail::Bvh8& tree_;
  std::vector<bool> reached_;
};

void expect_same_discs(std::vector<Disc> reached, const Hierarchy& hierarchy, std::uint32_t depth) {
  std::vector<Disc> expected;
  for (const std::uint32_t node : cut(hierarchy, depth)) expected.push_back(hierarchy.nodes[node].disc);
  const auto less = [](const Disc& a, const Disc& b) {
    return std::tie(a.x, a.y, a.radius) < std::tie(b.x, b.y, b.radius);
  };
  std::sort(reached.begin(), reached.end(), less);
  std::sort(expected.begin(), expected.end(), less);
  EXPECT_EQ(reached, expected);
}

TEST(Bvh8, HoldsTheCutAndNothingElse) {
  for (const Shape& shape : test::synthetic_shapes(21, 32))
    for (std::uint32_t depth = 0; depth <= height(shape.hierarchy) + 1; ++depth) {
      const detail::Bvh8 tree = detail::bvh8(shape.hierarchy, depth);
      const Walk walk(tree);
      EXPECT_EQ(tree.is_single(), walk.discs.size() == 1);
      expect_same_discs(walk.discs, shape.hierarchy, depth);
      EXPECT_LE(walk.levels, detail::most_wide_levels);
    }
}

/// Every way up from a disc of the cut is that of the hierarchy.
TEST(Bvh8, LinksLeadToTheRoot) {
  for (const Shape& shape : test::synthetic_shapes(22, 32))
    for (std::uint32_t depth = 0; depth <= height(shape.hierarchy) + 1; ++depth) {
      const detail::Bvh8 tree = detail::bvh8(shape.hierarchy, depth);
      const std::vector<HierarchyNode>& nodes = shape.hierarchy.nodes;
      const std::vector<std::uint32_t> discs = cut(shape.hierarchy, depth),
                                       ends = detail::subtree_ends(nodes);
      ASSERT_EQ(tree.inner.size(), discs.size());
      for (std::uint32_t i = 0; i < discs.size(); ++i) {
        std::uint32_t at = tree.inner[i].link >= detail::above_cut_disc ? i : i - 1;
        for (std::uint32_t node = discs[i]; node-- > 0;) {
          if (ends[node] <= discs[i]) continue;  // not above the disc
          EXPECT_EQ(nodes[node].disc, (Disc{tree.inner[at].x, tree.inner[at].y, tree.inner[at].radius}));
          const std::uint32_t above = tree.inner[at].link & ~detail::above_cut_disc;
          EXPECT_EQ(above == at, node == 0);
          at = above;
        }
      }
    }
}

/// A binary tree in which every first child is a leaf: as deep as it has leaves.
Hierarchy comb(std::uint32_t leaves) {
  Hierarchy hierarchy;
  hierarchy.reach = leaves * 0.01;
  for (std::uint32_t i = 0; i + 1 < leaves; ++i) {
    const float x = 0.01f * static_cast<float>(i);
    HierarchyNode inner, leaf;
    inner.disc = {x, 0, 1 + 0.01f * static_cast<float>(leaves)};
    inner.second_child = static_cast<std::uint32_t>(hierarchy.nodes.size()) + 2;
    leaf.disc = {x, 0, 0.02f};
    hierarchy.nodes.push_back(inner);
    hierarchy.nodes.push_back(leaf);
  }
  HierarchyNode last;
  last.disc = {0.01f * static_cast<float>(leaves), 0, 0.02f};
  hierarchy.nodes.push_back(last);
  return hierarchy;
}

TEST(Bvh8, StaysShallowWhateverTheBinaryTree) {
  for (const std::uint32_t leaves : {2u, 8u, 9u, 100u, 113u, 5000u}) {
    const Hierarchy hierarchy = comb(leaves);
    const Walk walk(detail::bvh8(hierarchy, all_depths));
    EXPECT_LE(walk.levels, detail::most_wide_levels) << leaves;
    expect_same_discs(walk.discs, hierarchy, all_depths);
  }
}

TEST(ShapeSet, LevelsFollowThePlan) {
  const std::vector<Shape> shapes = test::synthetic_shapes(22, 6);
  const ShapeSet set(shapes, {{0, 2, all_depths}, false});
  EXPECT_EQ(set.shape_count(), 6u);
  EXPECT_EQ(set.level_count(), 3u);
  EXPECT_FALSE(set.solid());
  const detail::ShapeSetView view = set.view();
  for (std::uint32_t s = 0; s < 6; ++s) {
    const Disc& root = shapes[s].hierarchy.nodes[0].disc;
    EXPECT_EQ(view.roots[3 * s].row, detail::single_disc);
    EXPECT_EQ((Disc{view.roots[3 * s].x, view.roots[3 * s].y, view.roots[3 * s].radius}), root);
    EXPECT_GE(view.roots[3 * s + 2].radius, root.radius);
  }
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(view.roots) % 64, 0u);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(view.nodes) % 64, 0u);
}

TEST(ShapeSet, BuildsOnlyWhatThePlanNames) {
  const std::vector<Shape> shapes = test::synthetic_shapes(23, 64);
  const auto bytes = [&](std::vector<std::uint32_t> depths, bool solid) {
    return ShapeSet(shapes, {std::move(depths), solid}).bytes() / 64;
  };
  EXPECT_EQ(bytes({0}, false), 16u);
  EXPECT_EQ(bytes({0}, true), 16u);
  EXPECT_LT(bytes({3}, false), bytes({6}, false));
  EXPECT_LT(bytes({6}, false), bytes({all_depths}, false));
  EXPECT_LT(bytes({all_depths}, false), bytes({all_depths}, true));
  EXPECT_TRUE(ShapeSet(std::vector<Shape>{{{}, fixed_cylinder(1)}}).roots_only());
}

TEST(ShapeSet, IsTheSameHoweverManyShapesWereExpected) {
  const std::vector<Shape> shapes = test::synthetic_shapes(25, 90);
  const ShapeSetPlan plan{{0, 3, all_depths}, true};
  PreparedShape prepared(plan);
  const auto bytes = [&](std::size_t expected) {
    ShapeSetBuilder builder(plan, expected);
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      prepared.prepare(shapes[s], s);
      builder.add(prepared);
    }
    const std::vector<float> nodes(builder.nodes().begin(), builder.nodes().end());
    const ShapeSet set = std::move(builder).finish();
    EXPECT_TRUE(std::equal(nodes.begin(), nodes.end(), set.arrays().nodes.begin()));
    EXPECT_EQ(set.arrays().nodes.size(), nodes.size() + detail::block_floats);
    return test::BakedBytes(set, {}).text();
  };
  const std::string unknown = bytes(0);
  for (const std::size_t expected : {65, 90, 100000}) EXPECT_EQ(bytes(expected), unknown) << expected;
}

TEST(ShapeSet, OfABuilderSoFarIsThatOfItsShapes) {
  for (const ShapeSetPlan& plan : {ShapeSetPlan{{0, 3, all_depths}, true}, ShapeSetPlan{{0}, true}}) {
    const std::vector<Shape> shapes = test::synthetic_shapes(27, 70);
    const std::span<const Shape> all(shapes);
    ShapeSetBuilder builder(plan, 70);
    PreparedShape prepared(plan);
    const auto bytes = [](const ShapeSet& set) { return test::BakedBytes(set, {}).text(); };
    EXPECT_EQ(bytes(builder.set()), bytes(ShapeSet(all.first(0), plan)));
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      prepared.prepare(shapes[s], s);
      builder.add(prepared);
      if (s % 23 != 0) continue;
      EXPECT_EQ(bytes(builder.set()), bytes(ShapeSet(all.first(s + 1), plan))) << s;
    }
    EXPECT_EQ(bytes(std::move(builder).finish()), bytes(ShapeSet(shapes, plan)));
  }
}

TEST(ShapeSet, BuilderOfRootsHasNoNodes) {
  const ShapeSetPlan plan{{0}, true};
  ShapeSetBuilder builder(plan);
  PreparedShape prepared(plan);
  prepared.prepare(test::synthetic_shapes(26, 1)[0], 0);
  builder.add(prepared);
  EXPECT_TRUE(builder.nodes().empty());
}

TEST(ShapeSet, RejectsBadPlansAndShapes) {
  const std::vector<Shape> shapes = test::synthetic_shapes(24, 2);
  EXPECT_THROW(ShapeSet(shapes, {{}, false}), std::invalid_argument);
  EXPECT_THROW(ShapeSet(shapes, {{3, 3}, false}), std::invalid_argument);
  EXPECT_THROW(ShapeSet(shapes, {{all_depths, 0}, false}), std::invalid_argument);
  std::vector<Shape> broken = shapes;
  broken[1].hierarchy.nodes.clear();
  EXPECT_THROW(ShapeSet{broken}, std::invalid_argument);
  broken = shapes;
  broken[1].outline.points[3].x = std::numeric_limits<float>::quiet_NaN();
  try {
    ShapeSet{broken};
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find("shape set: shape 1: outline: point 3"), 0u) << error.what();
  }
  EXPECT_NO_THROW(ShapeSet(broken, {{all_depths}, false, false}));  // asks for no outline
}

TEST(ShapeSet, MayBeEmpty) {
  const ShapeSet set(std::span<const Shape>{});
  EXPECT_EQ(set.shape_count(), 0u);
}

}  // namespace
}  // namespace bch
