// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/shape_validation.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/shape_set/shape_storage.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/test.hpp"

namespace bch {

/// In the names of tests.
static void PrintTo(const ShapeSetPlan& plan, std::ostream* out) {
  for (const std::uint32_t depth : plan.depths)
    *out << (depth == all_depths ? "all" : std::to_string(depth)) << "_";
  *out << (plan.outlines ? "outlines_" : "") << (plan.culling ? "culling data" : "plain");
}

namespace {

using test::PairScene;
using test::Random;

/// All that queries can say about a scene, on every instruction set.
std::vector<std::vector<std::uint8_t>> answers(const ShapeSet& set, const PairScene& scene) {
  std::vector<std::vector<std::uint8_t>> all;
  for (const Implementation& row : test::supported())
    collide(set, scene.crowd.agents(), scene.pairs, all.emplace_back(scene.pairs.size()), {&row});
  return all;
}

BuiltShape flat(const Shape& shape, const ShapeSetPlan& plan) {
  BuiltShape made(plan);
  made.prepare(shape, 0);
  return made;
}

class DynamicShapes : public testing::TestWithParam<ShapeSetPlan> {
 protected:
  Random random{81};
  std::vector<Shape> pool = test::synthetic_shapes(82, 60);
  std::vector<Shape> present{pool.begin(), pool.begin() + 12};
  ShapeSet start{present, GetParam()};
  DynamicShapeSet dynamic{start};

  BuiltShape prepared{GetParam()};  // of one shape after the other

  void replace(std::uint32_t shape, const Shape& by) {
    prepared.prepare(by, 0);
    dynamic.replace(shape, prepared);
    present[shape] = by;
  }

  void expect_as_if_built_anew() {
    const ShapeSet anew(present, GetParam());
    const PairScene scene = random_scene(random, anew, 3'000);
    EXPECT_EQ(answers(dynamic.set(), scene), answers(anew, scene));
    const Agents agents = scene.crowd.agents();
    EXPECT_EQ(test::candidate_pairs(dynamic.set(), agents), test::candidate_pairs(anew, agents));
  }
};

TEST_P(DynamicShapes, AnswerAsIfBuiltAnew) {
  expect_as_if_built_anew();
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 5; ++i) replace(random.below(12), pool[random.below(60)]);
    expect_as_if_built_anew();
  }
}

/// Single discs come and go.
TEST_P(DynamicShapes, MayBecomeSingleDiscs) {
  Shape disc = pool[20];
  disc.hierarchy.nodes.resize(1), disc.hierarchy.primitive_ranges.resize(1);
  disc.hierarchy.nodes[0].second_child = 0;
  for (int round = 0; round < 6; ++round) {
    for (std::uint32_t shape = 0; shape < 12; ++shape)
      replace(shape, random.below(3) == 0 ? disc : pool[random.below(60)]);
    expect_as_if_built_anew();
  }
  for (std::uint32_t shape = 0; shape < 12; ++shape) replace(shape, disc);
  expect_as_if_built_anew();
  for (std::uint32_t shape = 0; shape < 12; ++shape) replace(shape, pool[shape]);
  expect_as_if_built_anew();
}

TEST_P(DynamicShapes, TouchNoOther) {
  const detail::ShapeSetView before = dynamic.set().view();
  const auto largest = std::max_element(present.begin(), present.end(), [](const Shape& a, const Shape& b) {
    return a.hierarchy.nodes.size() < b.hierarchy.nodes.size();
  });
  const auto index = static_cast<std::uint32_t>(largest - present.begin());
  Shape smaller = *largest;
  ASSERT_TRUE(dynamic.try_replace(index, flat(smaller, GetParam())));
  EXPECT_EQ(dynamic.set().view().nodes, before.nodes);
  expect_as_if_built_anew();
}

TEST_P(DynamicShapes, NothingIsAllocatedOncePlacesAreLargeEnough) {
  std::vector<BuiltShape> flats;
  for (const Shape& shape : pool) flats.push_back(flat(shape, GetParam()));
  for (std::uint32_t shape = 0; shape < 12; ++shape)
    for (const BuiltShape& any : flats) dynamic.replace(shape, any);
  const std::size_t bytes = dynamic.set().bytes();
  const std::size_t count = test::allocation_count();
  for (std::uint32_t shape = 0; shape < 12; ++shape)
    for (const BuiltShape& any : flats) EXPECT_TRUE(dynamic.try_replace(shape, any));
  EXPECT_EQ(test::allocation_count(), count);
  EXPECT_EQ(dynamic.set().bytes(), bytes);
}

/// Also of one whose shapes no longer lie in order, and then it may be baked.
TEST_P(DynamicShapes, MayBeCopied) {
  for (int round = 0; round < 4; ++round) {
    for (int i = 0; i < 8; ++i) replace(random.below(12), pool[random.below(60)]);
    DynamicShapeSet copy(dynamic.set());
    validate(copy.set().arrays());
    dynamic = std::move(copy);
    expect_as_if_built_anew();
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, DynamicShapes,
                         testing::Values(ShapeSetPlan{}, ShapeSetPlan{{0}, false, false},
                                         ShapeSetPlan{{0, 3, all_depths}, true, true},
                                         ShapeSetPlan{{2, 5}, true}, ShapeSetPlan{{0, 6}, false, false}));

TEST(DynamicShapeSet, WhatDoesNotFitIsNotReplaced) {
  const std::vector<Shape> pool = test::synthetic_shapes(83, 40);
  const auto by_size = [](const Shape& a, const Shape& b) {
    return a.hierarchy.nodes.size() < b.hierarchy.nodes.size();
  };
  const Shape small = *std::min_element(pool.begin(), pool.end(), by_size),
              large = *std::max_element(pool.begin(), pool.end(), by_size);
  const std::vector<Shape> present = {small, large, small};
  const ShapeSet start(present);
  DynamicShapeSet dynamic(start);
  Random random(84);
  const PairScene scene = random_scene(random, start, 1'000);
  EXPECT_FALSE(dynamic.try_replace(0, flat(large, {})));
  EXPECT_EQ(answers(dynamic.set(), scene), answers(start, scene));
  dynamic.replace(0, flat(large, {}));
  EXPECT_TRUE(dynamic.try_replace(0, flat(large, {})));
  EXPECT_TRUE(dynamic.try_replace(0, flat(small, {})));
  EXPECT_EQ(answers(dynamic.set(), scene), answers(start, scene));
}

/// Nothing asks shapes of a set, which may come from a file, to begin on a cache line.
TEST(DynamicShapeSet, PlacesOfACopyDoNotReachIntoEachOther) {
  Random random(86);
  const ShapeSetPlan plan;
  const std::vector<Shape> shapes = {test::contour_shape(test::star(random, 61, 0.3, 0.5)),
                                     test::contour_shape(test::polygon({{0, 0}, {0.03f, 0}, {0, 0.04f}}))};
  detail::ShapeStorage tight;
  tight.depths.assign(plan.depths.begin(), plan.depths.end());
  tight.resize(plan, 2);
  detail::ShapeExtent end{.rows = detail::first_row};
  for (std::size_t s = 0; s < 2; ++s) {
    const BuiltShape shape = flat(shapes[s], plan);
    const detail::ShapeExtent size = detail::extent_of(shape.flat().shape);
    tight.allocate(end, size);
    tight.store(s, shape.flat(), end);
    detail::for_each_part([](std::size_t& sum, std::size_t more) { sum += more; }, end, size);
  }
  validate(tight.arrays());
  ASSERT_NE(tight.trees[1].top % 16, 0u);
  const ShapeSet start(tight.arrays(), nullptr);
  const PairScene scene = random_scene(random, start, 1'000);
  const auto expected = answers(start, scene);
  DynamicShapeSet dynamic(start);
  EXPECT_EQ(answers(dynamic.set(), scene), expected);
  // As much as a place of the first shape may hold.
  const detail::ShapeExtent place = detail::extent_of(flat(shapes[0], plan).flat().shape);
  std::size_t most = 0;
  for (int i = 0; i < 400; ++i) {
    const BuiltShape shape = flat(test::contour_shape(test::star(random, 61, 0.3, 0.5)), plan);
    if (dynamic.try_replace(0, shape)) most = std::max(most, detail::extent_of(shape.flat().shape).nodes);
  }
  EXPECT_GT(most, place.nodes);  // room that is left up to the next line
  ASSERT_TRUE(dynamic.try_replace(0, flat(shapes[0], plan)));
  EXPECT_EQ(answers(dynamic.set(), scene), expected);
}

/// What its header says: 4.5 times what the largest shapes need, each part by itself.
TEST(DynamicShapeSet, PlacesTakeLittleMoreThanTheLargestShapes) {
  const ShapeSetPlan plan{{all_depths}, true};
  Random random(88);
  const Outline outline = test::star(random, 500, 0.3, 0.5);
  DynamicShapeSet dynamic(ShapeSet(std::vector<Shape>{test::contour_shape(outline, 0.4f)}, plan));
  for (float threshold = 0.2f; threshold > 0.001f; threshold *= 0.9f) {
    const BuiltShape shape = flat(test::contour_shape(outline, threshold), plan);
    dynamic.replace(0, shape);
    const detail::ShapeArrays& arrays = dynamic.set().arrays();
    const detail::ShapeExtent size = detail::extent_of(shape.flat().shape);
    EXPECT_LE(arrays.nodes.size(), 4.5 * static_cast<double>(size.nodes) + 64) << threshold;
    EXPECT_EQ(arrays.support.size(), (detail::first_row + 1) * detail::support_stride);
    EXPECT_EQ(arrays.points.size(), size.points);
  }
}

TEST(DynamicShapeSet, RejectsOtherPlansAndShapesThatAreNotThere) {
  const std::vector<Shape> shapes = test::synthetic_shapes(85, 2);
  DynamicShapeSet dynamic(ShapeSet(shapes, {{0, all_depths}, true}));
  EXPECT_THROW(dynamic.replace(2, flat(shapes[0], dynamic.set().plan())), std::out_of_range);
  EXPECT_THROW(dynamic.replace(0, flat(shapes[0], {{0, all_depths}, false})), std::invalid_argument);
  EXPECT_THROW(dynamic.replace(0, flat(shapes[0], {{all_depths}, true})), std::invalid_argument);
  EXPECT_THROW(dynamic.try_replace(0, flat(shapes[0], {{0, all_depths}, true, false})),
               std::invalid_argument);
  DynamicShapeSet discs(ShapeSet(std::vector<Shape>{{{}, detail::fixed_cylinder(1)}}));
  EXPECT_THROW(discs.replace(0, flat(shapes[0], {})), std::invalid_argument);
}

}  // namespace
}  // namespace bch
