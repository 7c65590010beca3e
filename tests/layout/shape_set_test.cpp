// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/cut_discs.hpp"
#include "layout/format/leaf_segments.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/hierarchy/subtrees.hpp"
#include "layout/shape_set/bvh8.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

/// Walks a wide tree: its height in blocks and leaf blocks, and the discs that it reaches, which are those of a leaf block
/// below all nodes of the blocks above it (a leaf block may show neighbours of its group as well).
class Walk {
 public:
  explicit Walk(const detail::Bvh8& tree) : tree_(tree), reached_(tree.count) {
    visit(tree.top, {}, 1);
    for (std::size_t i = 0; i < reached_.size(); ++i)
      if (reached_[i]) discs.push_back(disc(detail::leaf_bit + static_cast<std::uint32_t>(i)));
  }
  std::vector<Disc> discs;
  std::uint32_t levels = 0;

 private:
  /// Of an inner node, or leaf_bit + a cut disc's index.
  Disc disc(std::uint32_t node) const {
    const std::uint32_t i = node & ~detail::leaf_bit;
    if (node >= detail::leaf_bit) return {tree_.x[i], tree_.y[i], tree_.radius[i]};
    return {tree_.inner_nodes[i].x, tree_.inner_nodes[i].y, tree_.inner_nodes[i].radius};
  }

  std::uint32_t above(std::uint32_t inner) const {
    return tree_.inner_nodes[inner].link & ~detail::parent_of_cut_disc;
  }

  bool is_above(std::uint32_t node, std::uint32_t i) const {
    if (node >= detail::leaf_bit) return node == detail::leaf_bit + i;
    std::uint32_t at = tree_.inner_nodes[i].link >= detail::parent_of_cut_disc ? i : i - 1;
    while (at != node && at != above(at)) at = above(at);
    return at == node;
  }

  void visit(std::uint32_t node, const std::vector<std::uint32_t>& nodes_above, std::uint32_t level) {
    levels = std::max(levels, level);
    if (node & detail::leaf_bit) return max_extent(node & ~detail::leaf_bit, nodes_above);
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

  void max_extent(std::uint32_t first, const std::vector<std::uint32_t>& nodes_above) {
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
    for (std::uint32_t depth = 0; depth <= detail::height(shape.hierarchy) + 1; ++depth) {
      const detail::Bvh8 tree = detail::bvh8(shape.hierarchy, depth);
      const Walk walk(tree);
      EXPECT_EQ(tree.is_single(), walk.discs.size() == 1);
      expect_same_discs(walk.discs, shape.hierarchy, depth);
      EXPECT_LE(walk.levels, detail::max_wide_levels);
    }
}

/// Every way up from a disc of the cut is that of the hierarchy.
TEST(Bvh8, LinksLeadToTheRoot) {
  for (const Shape& shape : test::synthetic_shapes(22, 32))
    for (std::uint32_t depth = 0; depth <= detail::height(shape.hierarchy) + 1; ++depth) {
      const detail::Bvh8 tree = detail::bvh8(shape.hierarchy, depth);
      const std::vector<Hierarchy::Node>& nodes = shape.hierarchy.nodes;
      const std::vector<std::uint32_t> discs = cut(shape.hierarchy, depth),
                                       ends = detail::subtree_ends(nodes);
      ASSERT_EQ(tree.inner_nodes.size(), discs.size());
      for (std::uint32_t i = 0; i < discs.size(); ++i) {
        std::uint32_t at = tree.inner_nodes[i].link >= detail::parent_of_cut_disc ? i : i - 1;
        for (std::uint32_t node = discs[i]; node-- > 0;) {
          if (ends[node] <= discs[i]) continue;  // not above the disc
          EXPECT_EQ(nodes[node].disc,
                    (Disc{tree.inner_nodes[at].x, tree.inner_nodes[at].y, tree.inner_nodes[at].radius}));
          const std::uint32_t above = tree.inner_nodes[at].link & ~detail::parent_of_cut_disc;
          EXPECT_EQ(above == at, node == 0);
          at = above;
        }
      }
    }
}

/// A binary tree in which every first child is a leaf: as deep as it has leaves.
Hierarchy comb(std::uint32_t leaves) {
  Hierarchy hierarchy;
  hierarchy.max_extent = leaves * 0.01;
  for (std::uint32_t i = 0; i + 1 < leaves; ++i) {
    const float x = 0.01f * static_cast<float>(i);
    Hierarchy::Node inner, leaf;
    inner.disc = {x, 0, 1 + 0.01f * static_cast<float>(leaves)};
    inner.second_child = static_cast<std::uint32_t>(hierarchy.nodes.size()) + 2;
    leaf.disc = {x, 0, 0.02f};
    hierarchy.nodes.push_back(inner);
    hierarchy.nodes.push_back(leaf);
  }
  Hierarchy::Node last;
  last.disc = {0.01f * static_cast<float>(leaves), 0, 0.02f};
  hierarchy.nodes.push_back(last);
  return hierarchy;
}

TEST(Bvh8, StaysShallowWhateverTheBinaryTree) {
  for (const std::uint32_t leaves : {2u, 8u, 9u, 100u, 113u, 5000u}) {
    const Hierarchy hierarchy = comb(leaves);
    const Walk walk(detail::bvh8(hierarchy, all_depths));
    EXPECT_LE(walk.levels, detail::max_wide_levels) << leaves;
    expect_same_discs(walk.discs, hierarchy, all_depths);
  }
}

TEST(ShapeSet, LevelsFollowThePlan) {
  const std::vector<Shape> shapes = test::synthetic_shapes(22, 6);
  const ShapeSet set(shapes, {{0, 2, all_depths}, false});
  EXPECT_EQ(set.shape_count(), 6u);
  EXPECT_EQ(set.level_count(), 3u);
  EXPECT_FALSE(set.plan().outlines);
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
  const auto bytes = [&](std::vector<std::uint32_t> depths, bool outlines) {
    return ShapeSet(shapes, {std::move(depths), outlines}).bytes() / 64;
  };
  EXPECT_EQ(bytes({0}, false), 16u);
  EXPECT_EQ(bytes({0}, true), 16u);
  EXPECT_LT(bytes({3}, false), bytes({6}, false));
  EXPECT_LT(bytes({6}, false), bytes({all_depths}, false));
  EXPECT_LT(bytes({all_depths}, false), bytes({all_depths}, true));
  EXPECT_LT(ShapeSet(shapes, {.culling = false}).bytes(), ShapeSet(shapes).bytes());
  EXPECT_TRUE(ShapeSet(std::vector<Shape>{{{}, detail::fixed_cylinder(1)}}).roots_only());
}

TEST(ShapeSet, IsTheSameHoweverManyShapesWereExpected) {
  const std::vector<Shape> shapes = test::synthetic_shapes(25, 90);
  const ShapeSetPlan plan{{0, 3, all_depths}, true};
  BuiltShape prepared(plan);
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
    BuiltShape prepared(plan);
    const auto bytes = [](const ShapeSet& set) { return test::BakedBytes(set, {}).text(); };
    EXPECT_EQ(bytes(builder.set()), bytes(ShapeSet(all.first(0), plan)));
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      prepared.prepare(shapes[s], s);
      builder.add(prepared);
      if (s % 23 != 0) continue;
      EXPECT_EQ(bytes(builder.set()), bytes(ShapeSet(all.first(s + 1), plan))) << s;
    }
    EXPECT_EQ(builder.nodes().empty(), plan.depths == std::vector<std::uint32_t>{0});
    EXPECT_EQ(bytes(std::move(builder).finish()), bytes(ShapeSet(shapes, plan)));
  }
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
  EXPECT_TRUE(test::has(test::complaint([&] { ShapeSet{broken}; }), "shape set: shape 1: outline: point 3"));
  EXPECT_NO_THROW(ShapeSet(broken, {{all_depths}, false, false}));  // asks for no outline
}

/// Levels of one disc, of fewer than a leaf block and of many, in sets with and without nodes.
TEST(CutDiscs, AreThoseOfTheCutInItsOrder) {
  const std::vector<Shape> shapes = test::synthetic_shapes(71, 24);
  std::size_t single = 0, few = 0, many = 0;
  for (const std::vector<std::uint32_t>& depths :
       {std::vector<std::uint32_t>{0}, {0, 1, 2, 4, 9, all_depths}}) {
    const ShapeSet set(shapes, {depths, false});
    for (std::uint32_t shape = 0; shape < shapes.size(); ++shape)
      for (std::uint32_t level = 0; level < depths.size(); ++level) {
        const detail::CutDiscs discs = detail::cut_discs(set.view(), shape * set.level_count() + level);
        const Hierarchy& hierarchy = shapes[shape].hierarchy;
        const std::vector<std::uint32_t> expected = cut(hierarchy, depths[level]);
        ASSERT_EQ(discs.count, expected.size());
        for (std::uint32_t i = 0; i < discs.count; ++i)
          ASSERT_EQ((Disc{discs.x[i], discs.y[i], discs.radius[i]}), hierarchy.nodes[expected[i]].disc);
        const std::vector<Disc> copied = set.discs(shape, level);
        ASSERT_EQ(copied.size(), discs.count);
        for (std::uint32_t i = 0; i < discs.count; ++i) {
          ASSERT_EQ(copied[i], hierarchy.nodes[expected[i]].disc);
          const double x = copied[i].x, y = copied[i].y, radius = copied[i].radius;
          ASSERT_LE(std::sqrt(x * x + y * y) + radius, static_cast<double>(set.bounding_radius(shape)));
        }
        ++(discs.count == 1 ? single : discs.count < detail::block_width ? few : many);
      }
  }
  EXPECT_GT(single, 24u);
  EXPECT_GT(few, 20u);
  EXPECT_GT(many, 20u);
}

TEST(ShapeSetDiscs, RejectIndicesOutOfRange) {
  const ShapeSet set(test::synthetic_shapes(72, 3));
  EXPECT_EQ(test::complaint<std::out_of_range>([&] { set.discs(3, 0); }), "shape set: shape 3 of 3");
  EXPECT_EQ(test::complaint<std::out_of_range>([&] { set.discs(0, 1); }), "shape set: level 1 of 1");
  EXPECT_EQ(test::complaint<std::out_of_range>([&] { set.bounding_radius(3); }), "shape set: shape 3 of 3");
}

/// A single disc reaches as far as it is large, about wherever it is.
TEST(ShapeSetDiscs, ReachHoldsTheShape) {
  const float radius = ShapeSet(std::vector<Shape>{{{}, detail::fixed_cylinder(0.5f)}}).bounding_radius(0);
  EXPECT_GE(radius, 0.5f);
  EXPECT_LT(radius, 0.50001f);
}

TEST(LeafSegments, AreRunsOrLists) {
  const std::vector<std::vector<std::uint32_t>> leaves = {{7}, {1, 2, 3}, {4, 6}, {0x1000000}, {9, 8}, {5}};
  std::vector<std::uint32_t> long_run(127);
  for (std::uint32_t i = 0; i < 127; ++i) long_run[i] = 50 + i;
  std::vector<std::uint32_t> words;
  for (std::size_t i = 0; i < leaves.size(); ++i) detail::add_leaf(leaves[i], i, leaves.size() + 1, words);
  detail::add_leaf(long_run, leaves.size(), leaves.size() + 1, words);
  for (std::size_t i = 0; i < leaves.size(); ++i) EXPECT_EQ(detail::segments_of(words, i), leaves[i]);
  EXPECT_EQ(detail::segments_of(words, leaves.size()), long_run);
  EXPECT_EQ(detail::leaf_segments_size(words, leaves.size() + 1), words.size());
  EXPECT_EQ(words.size(), 7 + 3 + 2 + 3);
  long_run.push_back(177);
  detail::add_leaf(long_run, 1, leaves.size() + 1, words);
  EXPECT_TRUE(detail::segments_of(words, 1).empty());
}

TEST(Plans, WithoutOutlinesHaveNoExactLeaves) {
  const std::vector<Shape> shapes = test::synthetic_shapes(2405, 8);
  EXPECT_TRUE(ShapeSet(shapes).exact_leaves());
  EXPECT_FALSE(ShapeSet(shapes, {.outlines = false}).exact_leaves());
  EXPECT_FALSE(ShapeSet(shapes, {{0, 3, 6}}).exact_leaves());
  EXPECT_EQ(ShapeSet(shapes, {.outlines = false}).arrays().points.size(), 0u);
  std::vector<Shape> bare = shapes;
  for (Shape& shape : bare) shape.hierarchy.of_segments = false;
  EXPECT_FALSE(ShapeSet(bare).exact_leaves());
  EXPECT_TRUE(ShapeSet(bare).plan().outlines);
}

TEST(HierarchyPrimitives, HaveToBeThoseOfTheOutline) {
  const std::pair<void (*)(Hierarchy&), const char*> changes[] = {
      {[](Hierarchy& h) { h.primitive_ranges.pop_back(); }, "shape 1: hierarchy:"},
      {[](Hierarchy& h) { h.primitive_ranges.back().end += 1; }, "holds primitives"},
      {[](Hierarchy& h) { h.primitive_ranges.back().begin = h.primitive_ranges.back().end = 9; },
       "holds primitives"},
      {[](Hierarchy& h) { h.source[0] = 100'000; }, "comes from segment 100000"}};
  for (const auto& [change, reason] : changes) {
    std::vector<Shape> changed = test::synthetic_shapes(2408, 2);
    change(changed[1].hierarchy);
    EXPECT_TRUE(test::has(test::complaint([&] { ShapeSet{changed}; }), reason));
  }
}

}  // namespace
}  // namespace bch
