// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/cut_soups.hpp"
#include "tests/support/test.hpp"

// Outlines between two heights against the exact arrangement of meshes that are clipped corner by corner.

namespace bch {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

void expect_arrangement(const Outline& found, const test::Soup& part) {
  EXPECT_EQ(test::on_grid(found), test::arrangement_outline(test::on_grid(part, found.grid_step)));
  test::expect_covers(found, part.positions, part.triangles);
}

/// Heights of vertices are a few numbers, and the mesh is cut at the same: triangles lie in cuts, touch them and end there.
TEST(CutSoups, HaveTheOutlinesOfTheirUnions) {
  test::Random random(26);
  const std::vector<float> all = {-infinity, 0.0f, 0.37f, 0.81f, 1.13f, 1.59f, 2.71f, infinity};
  int compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    test::Soup soup = test::random_soup(random);
    for (Vec3& p : soup.positions) p.z = all[1 + random.below(6)];
    const std::uint32_t bottom = random.below(7), top = bottom + 1 + random.below(7 - bottom);
    if (bottom == 0 && top == 7) continue;  // nothing is cut
    test::expect_right_cut(soup.positions, soup.triangles, {all[bottom], all[top]},
                           [&](const Outline& found, const test::Soup& part) {
                             expect_arrangement(found, part);
                             ++compared;
                           });
    if (HasFailure()) FAIL() << "soup " << i;
  }
  EXPECT_GT(compared, 10'000);
}

/// The highest corner is as high as a cut's number, and cuts lie half a step higher.
TEST(CutOutlines, OfNothingAreEmpty) {
  const std::vector<Vec3> positions = {{0, 0, 0.5f}, {1, 0, 0.5f}, {0, 1, 0.75f}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
  const auto contours = [&](const Heights& between) {
    return detail::MeshOutliner(triangles, positions, {.between = between}).outline(positions).contours();
  };
  EXPECT_EQ(contours({-infinity, 0.25f}), 0u);
  EXPECT_EQ(contours({0.25f, 0.5f}), 1u);
  EXPECT_EQ(contours({0.5f, 0.75f}), 1u);
  EXPECT_EQ(contours({0.75f, infinity}), 0u);
  Outline outline;
  EXPECT_EQ(OutlineBuilder(triangles, 3).build(positions, outline), (Heights{0.5f, 0.75f}));
}

/// Of tips that are hardly higher than a cut: beside the origin, and at it, where nothing reaches as far as an outline has to.
TEST(CutOutlines, OfTipsHaveThemOrNothing) {
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (const Vec3& tip : {Vec3{0.1f, 0.2f, 1}, Vec3{0, 0, 1}}) {
    const std::vector<Vec3> positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0, 0.5f, 0}, tip};
    for (float cut = 1; cut > 0.9999f; cut = std::nextafter(cut, 0.0f) - 1e-6f)
      test::expect_right_cut(positions, triangles, {cut, infinity}, expect_arrangement);
  }
}

TEST(CutOutlines, NeedHeights) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, NAN}, {0, 1, 1}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
  const std::string expected = "outline: the height of vertex 1 is not finite";
  EXPECT_EQ(test::complaint([&] {
              detail::MeshOutliner(triangles, std::vector<Vec3>(3), {.between = {.bottom = 0.5f}})
                  .outline(positions);
            }),
            expected);
  Outline outline;
  EXPECT_EQ(test::complaint([&] { OutlineBuilder(triangles, 3).build(positions, outline); }), expected);
}

}  // namespace
}  // namespace bch
