// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <polyclipping/clipper.hpp>

#include "layout/character/skinning.hpp"
#include "tests/support/cut_soups.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Outlines of bodies, whole and between two heights, against libpolyclipping, an independent implementation.

namespace bch {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;
using test::Positions;
using test::Triangles;

ClipperLib::cInt cross(IntPoint o, IntPoint a, IntPoint b) {
  return (a.X - o.X) * (b.Y - o.Y) - (a.Y - o.Y) * (b.X - o.X);
}

/// The hull of the squares of two steps around the corners, counter-clockwise (Andrew's monotone chain).
Path inflated(const std::array<IntPoint, 3>& triangle) {
  Path corners;
  for (const IntPoint& p : triangle)
    for (const int x : {-1, 1})
      for (const int y : {-1, 1}) corners.emplace_back(p.X + x, p.Y + y);
  std::sort(corners.begin(), corners.end(),
            [](const IntPoint& a, const IntPoint& b) { return a.X != b.X ? a.X < b.X : a.Y < b.Y; });
  Path hull;
  for (const bool back : {false, true}) {
    const std::size_t begin = hull.size();
    for (const IntPoint& p : corners) {
      while (hull.size() > begin + 1 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (!back) std::reverse(corners.begin(), corners.end());
  }
  return hull;
}

IntPoint on_grid(float x, float y, float step) {
  const auto steps = [step](float metres) {
    return static_cast<ClipperLib::cInt>(
        std::nearbyint(static_cast<double>(metres) / static_cast<double>(step)));
  };
  return {steps(x), steps(y)};
}

Paths inflated_union(Positions positions, Triangles triangles, float step) {
  ClipperLib::Clipper clipper;
  for (const auto& t : triangles) {
    std::array<IntPoint, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = on_grid(positions[t[k]].x, positions[t[k]].y, step);
    if (corners[0] == corners[1] && corners[1] == corners[2]) continue;
    clipper.AddPath(inflated(corners), ClipperLib::ptSubject, true);
  }
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  Paths contours;
  for (const ClipperLib::PolyNode* outer : tree.Childs) contours.push_back(outer->Contour);
  return contours;
}

double length(const Path& contour) {
  double sum = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const IntPoint a = contour[i], b = contour[(i + 1) % contour.size()];
    sum += std::hypot(static_cast<double>(b.X - a.X), static_cast<double>(b.Y - a.Y));
  }
  return sum;
}

/// Compares an outline with what libpolyclipping makes of the same triangles,
/// each inflated by a step of the outline's grid (so that what has no area gets some, and what touches
/// overlaps): every corner of the outline is inside the inflated one, and the areas differ by no more than a
/// band of 4 steps along the boundary.
void expect_equals_inflated_union(const Outline& outline, Positions positions, Triangles triangles) {
  const Paths around = inflated_union(positions, triangles, outline.grid_step);
  double larger = 0, smaller = 0, boundary = 0;
  for (const Path& contour : around) {
    larger += ClipperLib::Area(contour);
    boundary += length(contour);
  }
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    Path contour;
    for (const Vec2& p : outline.contour(c)) contour.push_back(on_grid(p.x, p.y, outline.grid_step));
    smaller += ClipperLib::Area(contour);
    boundary += length(contour);
    for (const IntPoint& p : contour)
      EXPECT_TRUE(std::any_of(around.begin(), around.end(),
                              [&](const Path& path) { return ClipperLib::PointInPolygon(p, path) != 0; }))
          << "contour " << c << ": " << p.X << ", " << p.Y;
  }
  EXPECT_GT(larger, smaller);
  EXPECT_LE(larger - smaller, 4 * (boundary + 4));
}

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
      expect_equals_inflated_union(outline, positions, character.triangles);
      test::expect_covers(outline, positions, character.triangles);
      const Outline alone = bch::outline(positions, character.triangles);
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

void expect_like_clipper(const Outline& found, const test::Soup& part) {
  expect_equals_inflated_union(found, part.positions, part.triangles);
  test::expect_covers(found, part.positions, part.triangles);
}

void expect_right_cuts(const std::vector<Character>& characters, std::uint32_t poses) {
  const std::vector<Heights> cuts = {{.top = 0.4f},    {0.4f, 1},   {1, 1.2f},
                                     {.bottom = 1.2f}, {-1, 0.01f}, {1.65f, 9}};
  for (const Character& character : characters) {
    detail::Skinner skinner(character);
    std::size_t turn = 0;
    for (const PoseTime& time : sample_poses(character, test::samples(poses))) {
      SCOPED_TRACE(character.name + ", clip " + std::to_string(time.clip) + ", " +
                   std::to_string(time.seconds) + " s");
      test::expect_right_cut(skinner.pose(time), character.triangles, cuts[turn++ % cuts.size()],
                             expect_like_clipper);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(DefaultCuts, HaveTheOutlinesOfTheirUnions) {
  expect_right_cuts(test::default_characters(), 90);
}

TEST(RealCuts, HaveTheOutlinesOfTheirUnions) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_right_cuts(test::real_characters(*data), 45);
}

}  // namespace
}  // namespace bch
