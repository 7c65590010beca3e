// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/time_of_impact.hpp>

#include "baselines/clearance_reference.hpp"
#include "baselines/contact_reference.hpp"
#include "baselines/reference.hpp"
#include "baselines/time_of_impact_reference.hpp"
#include "layout/shape_set/bvh8.hpp"
#include "tests/support/clearances.hpp"
#include "tests/support/scenes.hpp"

// Trees as deep as kernels' stacks allow, and cuts of more discs than people have.

namespace bch {
namespace {

using baselines::Method;

/// A chain of discs in a tree of which every inner node's first child is a leaf. All inner nodes overlap but for the fourth,
/// which is far above most leaves.
Shape comb(test::Random& random, std::uint32_t leaves) {
  Shape shape;
  std::vector<HierarchyNode>& nodes = shape.hierarchy.nodes;
  shape.hierarchy.reach = 2;
  double x = 0, y = 0, turn = random.uniform(-3, 3);
  for (std::uint32_t i = 0; i < leaves; ++i) {
    const Disc disc{static_cast<float>(x), static_cast<float>(y),
                    static_cast<float>(random.uniform(0.008, 0.012))};
    const bool is_last = i + 1 == leaves;
    if (!is_last) {
      const auto self = static_cast<std::uint32_t>(nodes.size());
      nodes.push_back({{disc.x, disc.y, i == 3 ? 0.4f : 2}, self + 2});
    }
    nodes.push_back({disc, 0});
    turn += random.uniform(-0.5, 0.5);
    x = std::clamp(x + 0.015 * std::cos(turn), -1.0, 1.0),
    y = std::clamp(y + 0.015 * std::sin(turn), -1.0, 1.0);
  }
  return shape;
}

std::uint32_t levels(const detail::Bvh8& tree, std::uint32_t node) {
  if (node >= detail::leaf_window) return 1;
  std::uint32_t below = 0;
  for (std::uint32_t lane = 0; lane < detail::block_width; ++lane)
    if (std::isfinite(tree.blocks[node].discs.x[lane]))
      below = std::max(below, levels(tree, tree.blocks[node].child[lane]));
  return below + 1;
}

class DeepTrees : public testing::Test {
 protected:
  DeepTrees() {
    for (std::uint32_t leaves = 58; leaves < 72; ++leaves) shapes.push_back(comb(random, leaves));
    shapes.push_back(test::contour_shape(test::star(random, 100, 0.3, 0.5), 0.004f));
    set = std::make_unique<ShapeSet>(shapes);
    scene = random_scene(random, *set, test::samples(1'500));
    // Coincident, or nearly so, where next to nothing can be left out.
    for (std::size_t i = 1; i < scene.crowd.x.size(); i += 6) {
      scene.crowd.x[i] = scene.crowd.x[i - 1] + random.uniform(-0.02, 0.02);
      scene.crowd.y[i] = scene.crowd.y[i - 1] + random.uniform(-0.02, 0.02);
    }
  }

  template <class Compare>
  void on_every_implementation(Compare compare) const {
    for (const Implementation& each : implementations())
      if (each.supported()) compare(each);
  }

  Agents agents() const { return scene.crowd.agents(); }

  test::Random random{321};
  std::vector<Shape> shapes;
  std::unique_ptr<ShapeSet> set;
  test::PairScene scene;
};

TEST_F(DeepTrees, AreDeep) {
  std::uint32_t most = 0;
  for (const Shape& shape : shapes) {
    const detail::Bvh8 tree = detail::bvh8(shape.hierarchy, all_depths);
    most = std::max(most, levels(tree, tree.top));
  }
  EXPECT_EQ(most, detail::most_wide_levels);
}

TEST_F(DeepTrees, CollideAndContacts) {
  const baselines::Reference discs(shapes, {});
  const baselines::CutLists cuts(shapes, {});
  const baselines::LeafSegments segments(shapes, {}, Leaves::segments);
  std::vector<std::uint8_t> expected;
  std::vector<std::uint64_t> offsets = {0};
  std::vector<DiscPair> contacts;
  for (const Pair pair : scene.pairs) {
    expected.push_back(discs.boundary(agents(), pair, Method::brute_force));
    for (const auto& [i, j] : baselines::contacts(cuts, agents(), pair, &segments))
      contacts.push_back({i, j});
    offsets.push_back(contacts.size());
  }
  EXPECT_GT(std::count(expected.begin(), expected.end(), 1), std::ssize(expected) / 6);
  on_every_implementation([&](const Implementation& each) {
    std::vector<std::uint8_t> hits(scene.pairs.size());
    collide(*set, agents(), scene.pairs, hits, {.implementation = &each});
    EXPECT_EQ(hits, expected) << each.name;
    ContactFinder finder;
    const Rows<DiscPair> table = finder.find(*set, agents(), scene.pairs, {.implementation = &each});
    EXPECT_TRUE(std::ranges::equal(table.offsets, offsets)) << each.name;
    EXPECT_TRUE(std::ranges::equal(table.values, contacts)) << each.name;
  });
}

TEST_F(DeepTrees, Clearance) {
  baselines::ClearanceReference reference(shapes, {});
  for (const double most : {0.05, 1e9}) {
    const test::Answers expected = test::answers(reference, scene, most, Method::brute_force);
    on_every_implementation([&](const Implementation& each) {
      const test::Answers of = test::answers(*set, agents(), scene.pairs, most, &each);
      for (std::size_t i = 0; i < scene.pairs.size(); ++i)
        ASSERT_TRUE(of.same(i, expected, i)) << each.name << ", pair " << i;
    });
  }
}

/// Shapes whose groups all lie over each other leave more steps open, of 32 pairs together, than a search lists.
TEST_F(DeepTrees, ClearanceOfMoreOpenStepsThanAreListed) {
  const Shape thistle = test::contour_shape(test::star(random, 100, 0.02, 0.35));
  const ShapeSet thistles({&thistle, 1});
  const test::PairScene together = [&] {
    test::PairScene all;
    for (std::uint32_t i = 0; i < 32; ++i) {
      for (int k = 0; k < 2; ++k)
        all.crowd.add(
            {0, random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), random.uniform(-3, 3), 0});
      all.pairs.push_back({2 * i, 2 * i + 1});
    }
    return all;
  }();
  baselines::ClearanceReference reference({&thistle, 1}, {});
  const test::Answers expected = test::answers(reference, together, 1e9, Method::brute_force);
  on_every_implementation([&](const Implementation& each) {
    const test::Answers of = test::answers(thistles, together.crowd.agents(), together.pairs, 1e9, &each);
    for (std::size_t i = 0; i < together.pairs.size(); ++i)
      ASSERT_TRUE(of.same(i, expected, i)) << each.name << ", pair " << i;
  });
}

TEST_F(DeepTrees, TimeOfImpact) {
  baselines::TimeOfImpactReference reference(shapes, {});
  std::vector<double> x, y;
  std::vector<float> expected;
  for (const auto& [first, second] : scene.pairs) {
    x.push_back(2 * (scene.crowd.x[second] - scene.crowd.x[first]) + random.uniform(-0.3, 0.3));
    y.push_back(2 * (scene.crowd.y[second] - scene.crowd.y[first]) + random.uniform(-0.3, 0.3));
    expected.push_back(reference.query(agents(), {first, second}, x.back(), y.back(), Method::brute_force));
  }
  const auto on_the_way =
      std::count_if(expected.begin(), expected.end(), [](float t) { return t > 0 && t <= 1; });
  EXPECT_GT(on_the_way, std::ssize(expected) / 6);
  on_every_implementation([&](const Implementation& each) {
    std::vector<float> times(scene.pairs.size());
    time_of_impact(*set, agents(), scene.pairs, {x, y}, times, {.implementation = &each});
    for (std::size_t i = 0; i < times.size(); ++i)
      ASSERT_EQ(times[i], expected[i]) << each.name << ", pair " << i;
  });
}

}  // namespace
}  // namespace bch
