// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/skinning.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

namespace bch {
namespace {

void expect_equal(const Shape& shape, const Shape& expected) {
  EXPECT_EQ(shape.outline.points, expected.outline.points);
  EXPECT_EQ(shape.outline.contour_begin, expected.outline.contour_begin);
  EXPECT_EQ(shape.outline.grid_step, expected.outline.grid_step);
  ASSERT_EQ(shape.hierarchy.nodes.size(), expected.hierarchy.nodes.size());
  for (std::size_t i = 0; i < expected.hierarchy.nodes.size(); ++i) {
    const Hierarchy::Node &node = shape.hierarchy.nodes[i], &other = expected.hierarchy.nodes[i];
    ASSERT_EQ(node.disc, other.disc) << i;
    ASSERT_EQ(node.second_child, other.second_child) << i;
  }
}

/// A shape made by the functions that make one alone.
Shape one_shape(detail::Skinner& skinner, PoseTime at, float threshold = 0.01f) {
  Shape shape{bch::outline(skinner.pose(at), skinner.character().triangles), {}};
  shape.hierarchy = contour_hierarchy(shape.outline, threshold);
  return shape;
}

TEST(PoseShaper, MakesTheShapesThatAreMadeOneByOne) {
  for (const Character& character : test::people())
    for (const float threshold : {0.01f, 0.1f}) {
      detail::Skinner skinner(character);
      PoseShaper shaper(character, {}, threshold);
      for (const PoseTime& time : sample_poses(character, 20))
        expect_equal(shaper.shape(time), one_shape(skinner, time, threshold));
    }
}

/// Depth 0 without an outline: the same disc, bit for bit.
TEST(PoseShaper, NeedsNoOutlineForTheRootAlone) {
  for (const Character& character : test::people()) {
    PoseShaper with(character, {.depths = {0}, .heights = true}), without(character, {.depths = {0}});
    for (const PoseTime& time : sample_poses(character, 200)) {
      const Hierarchy &expected = with.shape(time).hierarchy, &root = without.shape(time).hierarchy;
      ASSERT_EQ(root.nodes.size(), 1u);
      EXPECT_EQ(root.nodes[0].disc, expected.nodes[0].disc);
      EXPECT_TRUE(root.nodes[0].is_leaf());
      EXPECT_EQ(root.reach, expected.reach);
    }
  }
}

void expect_no_allocations_the_second_time(const ShapeSetPlan& plan) {
  const Character woman = default_female();
  PoseShaper shaper(woman, plan);
  const std::vector<PoseTime> times = sample_poses(woman, 20);
  const std::size_t before = test::allocation_count();
  for (const PoseTime& time : times) shaper.shape(time);
  const std::size_t first = test::allocation_count();
  EXPECT_GT(first, before);
  for (const PoseTime& time : times) shaper.shape(time);
  EXPECT_EQ(test::allocation_count(), first);
}

TEST(PoseShaper, AllocatesNothingTheSecondTime) {
  expect_no_allocations_the_second_time({});
  expect_no_allocations_the_second_time({.depths = {0}});
  expect_no_allocations_the_second_time({.heights = true});
}

TEST(PoseShaper, RejectsWhatItsPartsReject) {
  const Character man = default_male();
  EXPECT_THROW(PoseShaper(man, {}, -1.0f).shape({PoseTime::rest, 0}), std::invalid_argument);
  EXPECT_THROW(PoseShaper(man, {.depths = {0}}, -1.0f).shape({PoseTime::rest, 0}), std::invalid_argument);
  PoseShaper shaper(man);
  EXPECT_THROW(shaper.shape({static_cast<std::uint32_t>(man.clips.size()), 0}), std::invalid_argument);
  detail::Skinner skinner(man);
  expect_equal(shaper.shape({PoseTime::rest, 0}), one_shape(skinner, {PoseTime::rest, 0}));
}

}  // namespace
}  // namespace bch
