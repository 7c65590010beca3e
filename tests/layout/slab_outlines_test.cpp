// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <bch/hierarchy.hpp>
#include <bch/outline_builder.hpp>

#include "layout/base/planes.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/outline_checks.hpp"
#include "tests/support/outline_clipper.hpp"
#include "tests/support/outline_soups.hpp"
#include "tests/support/test_characters.hpp"

// Outlines of slabs against meshes that are clipped here, corner by corner in long double.

namespace bch {
namespace {

struct Point {
  long double x, y, z;
  long double
      at;  ///< the way round the triangle from its first corner: a corner's number, and shares of edges
};

/// What of a convex polygon lies below a plane (sign 1) or above it (-1).
std::vector<Point> clipped(const std::vector<Point>& polygon, long double plane, int sign) {
  std::vector<Point> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const bool p_in = sign * (p.z - plane) < 0, q_in = sign * (q.z - plane) < 0;
    if (p_in) rest.push_back(p);
    if (p_in != q_in) {
      const long double t = (plane - p.z) / (q.z - p.z);
      rest.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), plane,
                      p.at + t * ((q.at > p.at ? q.at : 3) - p.at)});
    }
  }
  return rest;
}

/// The part of a mesh that lies in a slab, with corners rounded to a grid.
test::Soup slab_of(test::Positions positions, test::Triangles triangles, std::span<const float> planes,
                   std::size_t slab, float grid_step) {
  test::Soup soup;
  for (const auto& corners : triangles) {
    std::vector<Point> polygon;
    for (const std::uint32_t v : corners)
      polygon.push_back(
          {positions[v].x, positions[v].y, positions[v].z, static_cast<long double>(polygon.size())});
    if (slab > 0) polygon = clipped(polygon, detail::height_of(planes[slab - 1]), -1);
    if (slab < planes.size() && !polygon.empty())
      polygon = clipped(polygon, detail::height_of(planes[slab]), 1);
    if (polygon.empty()) continue;
    std::sort(polygon.begin(), polygon.end(), [](const Point& p, const Point& q) { return p.at < q.at; });
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const Point& p : polygon)
      soup.positions.push_back({static_cast<float>(std::nearbyint(p.x / grid_step) * grid_step),
                                static_cast<float>(std::nearbyint(p.y / grid_step) * grid_step), 0});
    // A piece that is a point on the grid becomes a whisker of a step towards x = 0.
    const auto points = std::span(soup.positions).subspan(first);
    const bool is_cut = std::any_of(polygon.begin(), polygon.end(), [&](const Point& p) {
      return std::none_of(corners.begin(), corners.end(),
                          [&](std::uint32_t v) { return positions[v].z == p.z; });
    });
    if (std::all_of(points.begin(), points.end(), [&](const Vec3& p) { return p == points[0]; })) {
      if (!is_cut) continue;  // left out, as in whole meshes
      points[1].x += points[0].x < 0 ? grid_step : -grid_step;
    }
    for (std::uint32_t i = 2; i < polygon.size(); ++i)
      soup.triangles.push_back({first, first + i - 1, first + i});
  }
  return soup;
}

void expect_like_clipper(const Outline& slab, const test::Soup& clipped) {
  test::expect_equals_inflated_union(slab, clipped.positions, clipped.triangles);
  test::expect_covers(slab, clipped.positions, clipped.triangles);
}

void expect_arrangement(const Outline& slab, const test::Soup& clipped) {
  EXPECT_EQ(test::on_grid(slab), test::arrangement_outline(test::on_grid(clipped, slab.grid_step)));
  test::expect_covers(slab, clipped.positions, clipped.triangles);
}

template <class Expect>
void expect_right_slabs(OutlineBuilder& builder, test::Positions positions, test::Triangles triangles,
                        std::span<const float> planes, Expect expect) {
  std::vector<Outline> slabs(planes.size() + 1);
  builder.build(positions, planes, slabs);
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    SCOPED_TRACE("slab " + std::to_string(i));
    const test::Soup soup = slab_of(positions, triangles, planes, i, slabs[i].grid_step);
    if (slabs[i].contours() == 0) {
      EXPECT_TRUE(soup.triangles.empty());
      continue;
    }
    validate(slabs[i]);
    const bool is_square = std::all_of(soup.positions.begin(), soup.positions.end(),
                                       [](const Vec3& p) { return std::hypot(p.x, p.y) < 1e-6f; });
    if (is_square)
      test::expect_covers(slabs[i], soup.positions, soup.triangles);
    else
      expect(slabs[i], soup);
  }
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
      expect_right_slabs(builder, skinner.pose(time), character.triangles, cuts[turn++ % cuts.size()],
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
      expect_right_slabs(builder, soup.positions, soup.triangles, std::span(all).subspan(begin, count),
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
