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
#include "tests/support/test_characters.hpp"

// OutlineBuilder against libpolyclipping and against samples.

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

}  // namespace
}  // namespace bch
