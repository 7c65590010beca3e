// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <string>

#include <bch/outline_builder.hpp>

#include "layout/character/skinning.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/outline_clipper.hpp"
#include "tests/support/outline_soups.hpp"
#include "tests/support/slab_soups.hpp"
#include "tests/support/test_characters.hpp"

// Outlines of bodies and of slabs against libpolyclipping and against samples.

namespace bch {
namespace {

void expect_right_outlines(const std::vector<Character>& characters, std::uint32_t poses) {
  for (const Character& character : characters) {
    detail::Skinner skinner(character);
    OutlineBuilder builder(character.triangles, character.vertices.size(), character.vertices);
    Outline outline;
    for (const PoseTime& time : sample_poses(character, test::samples(poses))) {
      SCOPED_TRACE(character.name + ", clip " + std::to_string(time.clip) + ", " +
                   std::to_string(time.seconds) + " s");
      const auto positions = skinner.pose(time);
      builder.build(positions, outline);
      test::expect_equals_inflated_union(outline, positions, character.triangles);
      test::expect_covers(outline, positions, character.triangles);
      test::expect_equals_samples(outline, positions, character.triangles, 100);
      const Outline alone = union_outline(positions, character.triangles);
      EXPECT_EQ(outline.points, alone.points);
      EXPECT_EQ(outline.contour_begin, alone.contour_begin);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(DefaultPoses, HaveTheOutlinesOfTheirUnions) {
  expect_right_outlines(test::default_characters(), 100);
}

TEST(RealPoses, HaveTheOutlinesOfTheirUnions) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_right_outlines(test::real_characters(*data), 50);
}

TEST(Soups, HaveTheOutlinesOfTheirUnions) {
  test::Random random(6);
  int compared = 0;
  for (int i = 0; i < 10000; ++i) {
    const test::Soup soup = test::random_soup(random);
    Outline outline;
    try {
      outline = union_outline(soup.positions, soup.triangles);
    } catch (const std::invalid_argument&) {
      continue;  // a soup of points
    }
    ++compared;
    test::expect_equals_inflated_union(outline, soup.positions, soup.triangles);
    if (HasFailure()) FAIL() << "soup " << i;
  }
  EXPECT_GT(compared, 9900);
}

void expect_like_clipper(const Outline& slab, const test::Soup& clipped) {
  test::expect_equals_inflated_union(slab, clipped.positions, clipped.triangles);
  test::expect_covers(slab, clipped.positions, clipped.triangles);
}

void expect_right_slabs(const std::vector<Character>& characters, std::uint32_t poses) {
  const std::vector<std::vector<float>> cuts = {
      {0.4f, 1.0f}, {0.35f, 0.7f, 0.85f, 0.95f, 1.05f, 1.2f, 1.45f}, {-1, 0.01f, 1.65f, 9}};
  for (const Character& character : characters) {
    detail::Skinner skinner(character);
    OutlineBuilder builder(character.triangles, character.vertices.size(), character.vertices);
    std::size_t turn = 0;
    for (const PoseTime& time : sample_poses(character, test::samples(poses))) {
      SCOPED_TRACE(character.name + ", clip " + std::to_string(time.clip) + ", " +
                   std::to_string(time.seconds) + " s");
      test::expect_right_slabs(builder, skinner.pose(time), character.triangles, cuts[turn++ % cuts.size()],
                               expect_like_clipper);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(DefaultSlabs, HaveTheOutlinesOfTheirUnions) {
  expect_right_slabs(test::default_characters(), 30);
}

TEST(RealSlabs, HaveTheOutlinesOfTheirUnions) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_right_slabs(test::real_characters(*data), 15);
}

}  // namespace
}  // namespace bch
