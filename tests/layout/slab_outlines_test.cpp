// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/skinning.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/outline_soups.hpp"
#include "tests/support/slab_soups.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Outlines of slabs against the exact arrangement of meshes that are clipped corner by corner.

namespace bch {
namespace {

void expect_arrangement(const Outline& slab, const test::Soup& clipped) {
  EXPECT_EQ(test::on_grid(slab), test::arrangement_outline(test::on_grid(clipped, slab.grid_step)));
  test::expect_covers(slab, clipped.positions, clipped.triangles);
}

/// Heights are a few numbers, and planes are the same: triangles lie in planes, touch them and end there.
TEST(SlabsOfSoups, HaveTheOutlinesOfTheirUnions) {
  test::Random random(26);
  int compared = 0;
  const std::vector<float> all = {0.0f, 0.37f, 0.81f, 1.13f, 1.59f, 2.71f};
  for (int i = 0; i < 10000; ++i) {
    test::Soup soup = test::random_soup(random);
    for (Vec3& p : soup.positions) p.z = all[random.below(6)];
    const std::size_t begin = random.below(4),
                      count = 1 + random.below(static_cast<std::uint32_t>(5 - begin));
    OutlineBuilder builder(soup.triangles, soup.positions.size(), soup.positions);
    try {
      test::expect_right_slabs(builder, soup.positions, soup.triangles, std::span(all).subspan(begin, count),
                               expect_arrangement);
    } catch (const std::invalid_argument&) {
      continue;  // a soup of points
    }
    ++compared;
    if (HasFailure()) FAIL() << "soup " << i;
  }
  EXPECT_GT(compared, 9900);
}

TEST(SlabOutlines, OfNoPlaneAreTheOutline) {
  for (const Character& character : test::default_characters()) {
    detail::Skinner skinner(character);
    OutlineBuilder builder(character.triangles, character.vertices.size(), character.vertices);
    for (const PoseTime& time : sample_poses(character, 10)) {
      Outline whole, slab;
      builder.build(skinner.pose(time), whole);
      builder.build(skinner.pose(time), std::span<const float>(), std::span(&slab, 1));
      EXPECT_EQ(slab.points, whole.points);
      EXPECT_EQ(slab.contour_begin, whole.contour_begin);
      EXPECT_EQ(slab.grid_step, whole.grid_step);
    }
  }
}

TEST(SlabOutlines, SayHeightsAndWhichSlabsAreEmpty) {
  const std::vector<Vec3> positions = {{0, 0, 0.5f}, {1, 0, 0.5f}, {0, 1, 0.75f}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
  OutlineBuilder builder(triangles, 3);
  std::vector<Outline> slabs(4);
  const Heights heights = builder.build(positions, std::vector<float>{0.25f, 0.5f, 0.75f}, slabs);
  EXPECT_EQ(heights, (Heights{0.5f, 0.75f}));
  EXPECT_EQ(slabs[0].contours(), 0u);
  // The lower edge lies in a plane, and planes lie half a step higher.
  EXPECT_EQ(slabs[1].contours(), 1u);
  EXPECT_EQ(slabs[2].contours(), 1u);
  EXPECT_EQ(slabs[3].contours(), 0u);
}

/// The tip of a spike that is smaller than the grid is still there.
TEST(SlabOutlines, KeepWhatIsSmallerThanTheGrid) {
  const std::vector<Vec3> positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0, 0.5f, 0}, {0.1f, 0.2f, 1}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  OutlineBuilder builder(triangles, 4);
  std::vector<Outline> slabs(2);
  builder.build(positions, std::vector<float>{std::nextafter(1.0f, 0.0f)}, slabs);
  ASSERT_EQ(slabs[1].contours(), 1u);
  test::expect_covers(slabs[1], std::vector<Vec3>{{0.1f, 0.2f, 0}, {0.1f, 0.2f, 0}, {0.1f, 0.2f, 0}},
                      std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
}

/// A tip at the origin is nearer to it than the smallest reach.
TEST(SlabOutlines, HaveAReachThatHierarchiesTake) {
  const std::vector<Vec3> positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0, 0.5f, 0}, {0, 0, 1}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  OutlineBuilder builder(triangles, 4);
  std::vector<Outline> slabs(2);
  builder.build(positions, std::vector<float>{std::nextafter(1.0f, 0.0f)}, slabs);
  ASSERT_EQ(slabs[1].contours(), 1u);
  EXPECT_GE(validate(slabs[1]), 1e-6);
  EXPECT_LT(validate(slabs[1]), 4e-6);
  EXPECT_EQ(contour_hierarchy(slabs[1], 0.01f).nodes.size(), 1u);
  test::expect_covers(slabs[1], std::vector<Vec3>{positions[3], positions[3], positions[3]},
                      std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
}

TEST(SlabOutlines, RejectsWhatIsNoCut) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
  OutlineBuilder builder(triangles, 3);
  std::vector<Outline> slabs(3);
  const auto complaint = [&](std::vector<float> planes, std::vector<Vec3> at) {
    return test::complaint<std::invalid_argument>([&] { builder.build(at, planes, slabs); });
  };
  EXPECT_EQ(complaint({1}, positions), "outline: 3 slabs for 1 planes");
  EXPECT_EQ(complaint({1, 1}, positions), "slices: plane 1 at 1 m does not ascend");
  EXPECT_EQ(complaint({NAN, 1}, positions), "slices: plane 0 at nan m is not within 1e6 m");
  EXPECT_EQ(complaint({0, 1}, {{0, 0, 0}, {1, 0, NAN}, {0, 1, 1}}),
            "outline: the height of vertex 1 is not finite");
}

}  // namespace
}  // namespace bch
