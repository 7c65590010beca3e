// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <system_error>

#include "kernel/obstacles/segment.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/cut_soups.hpp"
#include "tests/support/test.hpp"

// outline(): meshes with holes, between heights, in many poses, and as text.

namespace bch {
namespace {

using test::Soup;

/// Adds a rectangle at a height, as two triangles.
void add_rectangle(Soup& to, Vec2 low, Vec2 high, float z = 0) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  for (const Vec2 p : {low, Vec2{high.x, low.y}, high, Vec2{low.x, high.y}})
    to.positions.push_back({p.x, p.y, z});
  to.triangles.push_back({first, first + 1, first + 2});
  to.triangles.push_back({first, first + 3, first + 2});  // seen from below
}

/// A frame of four bars that overlap at its corners, and a plate in the middle, which is higher.
Soup frame() {
  Soup soup;
  add_rectangle(soup, {0, 0}, {4, 1});
  add_rectangle(soup, {0, 3}, {4, 4});
  add_rectangle(soup, {0, 0}, {1, 4});
  add_rectangle(soup, {3, 0}, {4, 4});
  add_rectangle(soup, {1.5f, 1.5f}, {2.5f, 2}, 1);
  return soup;
}

Outline outline_of(const Soup& soup, const OutlineOptions& options = {}) {
  return outline(soup.positions, soup.triangles, options);
}

const OutlineOptions with_holes{.holes = true};

TEST(MeshOutline, HasHolesAndWhatLiesInThem) {
  EXPECT_EQ(to_wkt(outline_of(frame(), with_holes)),
            "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 3, 3 3, 3 1, 1 1)), "
            "((1.5 1.5, 2.5 1.5, 2.5 2, 1.5 2, 1.5 1.5)))");
  EXPECT_EQ(to_geojson(outline_of(frame(), with_holes)),
            R"({"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,4],[0,4],[0,0]],)"
            R"([[1,1],[1,3],[3,3],[3,1],[1,1]]],[[[1.5,1.5],[2.5,1.5],[2.5,2],[1.5,2],[1.5,1.5]]]]})");
  EXPECT_EQ(to_wkt(outline_of(frame())), "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0)))");
}

TEST(MeshOutline, IsOfWhatLiesBetweenHeights) {
  const std::string plate = "MULTIPOLYGON (((1.5 1.5, 2.5 1.5, 2.5 2, 1.5 2, 1.5 1.5)))";
  for (const bool holes : {false, true}) {
    EXPECT_EQ(to_wkt(outline_of(frame(), {.between = {.bottom = 0.5f}, .holes = holes})), plate);
    EXPECT_EQ(to_wkt(outline_of(frame(), {.between = {0.5f, 0.75f}, .holes = holes})), "MULTIPOLYGON EMPTY");
  }
  EXPECT_EQ(to_wkt(outline_of(frame(), {.between = {.top = 0.5f}, .holes = true})),
            "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 3, 3 3, 3 1, 1 1)))");
}

/// A bow tie is two polygons, and a triangle seen edge-on is none.
TEST(MeshOutline, TextHasPolygonsAlone) {
  Soup soup;
  add_rectangle(soup, {0, 0}, {1, 1});
  add_rectangle(soup, {1, 1}, {2, 2});
  soup.positions.insert(soup.positions.end(), {{1, 0.5f, 0}, {3, 0.5f, 0}, {2, 0.5f, 1}});
  soup.triangles.push_back({8, 9, 10});
  const Outline plain = outline_of(soup);
  ASSERT_EQ(plain.contours(), 1u);
  EXPECT_EQ(plain.contour(0).size(), 11u);
  for (const Outline& outline : {plain, outline_of(soup, with_holes)}) {
    const std::string text = to_wkt(outline);
    EXPECT_NE(text.find("((0 0, 1 0, 1 1, 0 1, 0 0))"), std::string::npos) << text;
    EXPECT_NE(text.find("((1 1, 2 1, 2 2, 1 2, 1 1))"), std::string::npos) << text;
    EXPECT_EQ(text.size(),
              std::string("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((1 1, 2 1, 2 2, 1 2, 1 1)))").size());
  }
}

/// How often contours go round a point, counter-clockwise; `near`: whether it is within a distance of one.
int winding(const Outline& outline, double x, double y, double distance, bool& near) {
  int turns = 0;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto ring = outline.contour(c);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      const double ax = double{a.x} - x, ay = double{a.y} - y, bx = double{b.x} - x, by = double{b.y} - y,
                   wx = bx - ax, wy = by - ay;
      const double at = std::clamp(-(ax * wx + ay * wy) / std::max(wx * wx + wy * wy, 1e-30), 0.0, 1.0);
      near |= std::hypot(ax + at * wx, ay + at * wy) <= distance;
      if ((ay > 0) != (by > 0) && (by > ay) == (ax * by - ay * bx > 0)) turns += by > ay ? 1 : -1;
    }
  }
  return turns;
}

/// The triangles of a soup as contours.
Outline triangles_of(const Soup& soup) {
  Outline all;
  for (const auto& triangle : soup.triangles) {
    for (const std::uint32_t v : triangle) all.points.push_back({soup.positions[v].x, soup.positions[v].y});
    all.contour_begin.push_back(static_cast<std::uint32_t>(all.points.size()));
  }
  return all;
}

bool is_in_a_triangle(const Soup& soup, double x, double y) {
  return std::any_of(soup.triangles.begin(), soup.triangles.end(), [&](const auto& triangle) {
    bool near = false;
    return winding(triangles_of({soup.positions, {triangle}}), x, y, 0, near) != 0;
  });
}

/// Contours with holes are around exactly what triangles cover; they come to no point twice, and holes go clockwise.
TEST(MeshOutline, CoversWhatTrianglesCover) {
  test::Random random(20261128);
  std::size_t inside = 0, outside = 0, holes = 0;
  for (int i = 0; i < 3000; ++i) {
    const Soup soup = test::random_soup(random);
    if (test::complaint([&] { outline_of(soup); }) != "accepted") continue;  // nothing but points
    const Outline found = outline_of(soup, with_holes);
    for (std::size_t c = 0; c < found.contours(); ++c) {
      std::vector<std::pair<float, float>> corners;
      for (const Vec2& p : found.contour(c)) corners.push_back({p.x, p.y});
      holes += area({{found.contour(c).begin(), found.contour(c).end()},
                     {0, static_cast<std::uint32_t>(corners.size())}}) < 0;
      std::sort(corners.begin(), corners.end());
      ASSERT_EQ(std::adjacent_find(corners.begin(), corners.end()), corners.end()) << i;
    }
    for (int k = 0; k < 40; ++k) {
      const Vec3& about = soup.positions[random.below(static_cast<std::uint32_t>(soup.positions.size()))];
      constexpr double unit = 0x1p-10;
      const double x = double{about.x} + unit * random.uniform(-4, 4),
                   y = double{about.y} + unit * random.uniform(-4, 4);
      bool near = false;
      const double rounding = 3 * static_cast<double>(found.grid_step);
      const int turns = winding(found, x, y, rounding, near);
      // What is narrower than the grid may have come to nothing.
      winding(triangles_of(soup), x, y, rounding, near);
      if (near) continue;
      const bool covered = is_in_a_triangle(soup, x, y);
      ASSERT_EQ(turns, covered ? 1 : 0) << i << ": " << x << ' ' << y << '\n' << to_wkt(found);
      ++(covered ? inside : outside);
    }
  }
  EXPECT_GT(inside, 5000u);
  EXPECT_GT(outside, 5000u);
  EXPECT_GT(holes, 500u);
}

std::set<std::vector<std::pair<float, float>>> rings_of(const Outline& outline) {
  std::set<std::vector<std::pair<float, float>>> rings;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    std::vector<std::pair<float, float>> ring;
    for (const Vec2& p : outline.contour(c)) ring.emplace_back(p.x, p.y);
    rings.insert(ring);
  }
  return rings;
}

TEST(MeshOutline, HasTheSameExteriorsWithHolesAsWithout) {
  const Character woman = default_female();
  const std::vector<PoseTime> poses = sample_poses(woman, 12);
  std::size_t holes = 0;
  for (const Heights between : {Heights{}, Heights{0.3f, 1.1f}, Heights{.bottom = 1}}) {
    const auto plain = outlines(woman, poses, {.between = between});
    const auto holed = outlines(woman, poses, {.between = between, .holes = true});
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_TRUE(std::ranges::includes(rings_of(holed[i]), rings_of(plain[i]))) << i;
      holes += area(holed[i]) < area(plain[i]);
    }
  }
  EXPECT_GT(holes, 0u);
}

TEST(MeshOutline, IsThatOfEachPoseOfMany) {
  const Character man = default_male();
  const std::vector<PoseTime> poses = sample_poses(man, 20);
  detail::Skinner skinner(man);
  std::vector<Vec3> all;
  for (const PoseTime& at : poses) all.insert(all.end(), skinner.pose(at).begin(), skinner.pose(at).end());
  const auto by_pose = outlines(man, poses), by_mesh = outlines(all, man.vertices.size(), man.triangles);
  ASSERT_EQ(by_mesh.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Outline alone = outline(man, poses[i]);
    EXPECT_EQ(by_pose[i].points, alone.points) << i;
    EXPECT_EQ(by_mesh[i].points, alone.points) << i;
  }
}

/// Read back as obstacles, text has the same points, as floats.
TEST(MeshOutline, TextIsReadBack) {
  const Outline found = outline_of(frame(), with_holes);
  const ObstacleSet read = obstacles_from_wkt(to_wkt(found));
  EXPECT_EQ(read.obstacle_count(), 2u);
  EXPECT_EQ(read.segment_count(), 12u);
  const Outline man = outline(default_male(), {1, 0.7f}, with_holes);
  std::vector<double> x, y;
  for (const Vec2& p : man.points) x.push_back(double{p.x}), y.push_back(double{p.y});
  const std::vector<std::uint64_t> rings(man.contour_begin.begin(), man.contour_begin.end());
  const std::vector<std::uint8_t> is_area(man.contours(), 1);
  const ObstacleSet expected({.x = x, .y = y, .polyline_offsets = rings, .is_area = is_area});
  const ObstacleSet text = obstacles_from_wkt(to_wkt(man));
  ASSERT_EQ(text.segment_count(), expected.segment_count());
  for (std::uint32_t i = 0; i < text.segment_count(); ++i) {
    const detail::WorldSegment &is = text.view().segments[i], &was = expected.view().segments[i];
    const auto same = [](double one, double other) {
      return static_cast<float>(one) == static_cast<float>(other);
    };
    EXPECT_TRUE(same(is.ax, was.ax) && same(is.ay, was.ay) && same(is.bx, was.bx) && same(is.by, was.by))
        << i;
  }
}

TEST(MeshOutline, GridFollowsTheSize) {
  for (const float size : {1e-5f, 0.01f, 1.0f, 100.0f, 5e5f}) {
    Soup soup;
    add_rectangle(soup, {0, 0}, {size, size});
    const Outline square = outline_of(soup);
    EXPECT_NEAR(area(square) / (static_cast<double>(size) * static_cast<double>(size)), 1, 1e-6) << size;
    EXPECT_GE(square.grid_step, size * 0x1p-24f);
    EXPECT_LE(square.grid_step, size * 0x1p-22f);
    if (size == 1) {
      EXPECT_EQ(square.grid_step, 0x1p-22f);
    }
  }
}

TEST(MeshOutline, RefusesBadInput) {
  Soup soup = frame();
  const auto complaint_about = [&](const OutlineOptions& options) {
    return test::complaint([&] { outline_of(soup, options); });
  };
  EXPECT_EQ(complaint_about({.between = {1, 1}}), "outline: between 1 and 1 m there is nothing");
  EXPECT_EQ(complaint_about({.between = {std::numeric_limits<float>::quiet_NaN(), 1}}),
            "outline: between nan and 1 m there is nothing");
  for (const auto& [size, max_extent] : {std::pair(0.0f, "0"), {1e-8f, "4e-08"}, {1e6f, "4e+06"}}) {
    soup = frame();
    for (Vec3& p : soup.positions) p = {size * p.x, size * p.y, p.z};
    EXPECT_EQ(complaint_about({}),
              std::string("outline: expected an extent of 1e-6 to 1e6 m, found ") + max_extent);
  }
  soup = {};
  EXPECT_EQ(complaint_about({}), "outline: no triangles");
  for (const bool holes : {false, true}) {
    soup = frame();
    soup.positions[2].y = std::numeric_limits<float>::infinity();
    EXPECT_EQ(complaint_about({.holes = holes}), "outline: vertex 2 is not finite");
    soup = frame();
    soup.triangles[1][0] = 99;
    EXPECT_EQ(complaint_about({.holes = holes}), "outline: triangle 1 names vertex 99");
    soup = frame();
    std::vector<Vec3> two = soup.positions;
    two.insert(two.end(), soup.positions.begin(), soup.positions.end());
    two[soup.positions.size() + 3].x = 1e9f;
    EXPECT_EQ(
        test::complaint([&] { outlines(two, soup.positions.size(), soup.triangles, {.holes = holes}); }),
        "pose 1: outline: expected an extent of 1e-6 to 1e6 m, found 1e+09");
  }
  EXPECT_THROW(outlines(soup.positions, 7, soup.triangles), std::invalid_argument);
  EXPECT_THROW(outlines(default_male(), sample_poses(default_male(), 400),
                        {.progress = [](std::size_t, std::size_t) { return false; }}),
               std::system_error);
}

// ---- Outlines between two heights against the exact arrangement of meshes that are clipped corner by corner.

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
