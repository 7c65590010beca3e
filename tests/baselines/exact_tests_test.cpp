// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/exact_tests.hpp"

#include "tests/support/test.hpp"

// Segments and triangles with integer corners, against a method that shares nothing with the one tested: two
// convex sets meet exactly if the origin is a convex combination of differences of their corners, and by
// Caratheodory's theorem four of those differences are enough. Integers of 128 bits decide that.

namespace bch::baselines {
namespace {

__extension__ using Integer = __int128;
struct Vector {
  Integer x, y, z;
};

Integer dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
bool is_zero(const Vector& v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// The origin is a convex combination of two points.
bool within(const Vector& a, const Vector& b) {
  return is_zero(cross(a, b)) && dot(a, b) <= 0;
}

/// Of three points in a plane through the origin that are not on one line.
bool within(const Vector& a, const Vector& b, const Vector& c) {
  const Vector normal = cross(b - a, c - a);
  if (is_zero(normal) || dot(normal, a) != 0) return false;
  // The signs of the three areas, by the largest part of their parallel normals: small enough for 128 bits.
  const auto size = [](Integer value) { return value < 0 ? -value : value; };
  const auto largest = [&](const Vector& v) {
    if (size(normal.x) >= size(normal.y) && size(normal.x) >= size(normal.z))
      return normal.x < 0 ? -v.x : v.x;
    if (size(normal.y) >= size(normal.z)) return normal.y < 0 ? -v.y : v.y;
    return normal.z < 0 ? -v.z : v.z;
  };
  return largest(cross(a, b)) >= 0 && largest(cross(b, c)) >= 0 && largest(cross(c, a)) >= 0;
}

/// Of four points that are not in one plane.
bool within(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const auto volume = [](const Vector& p, const Vector& q, const Vector& r) { return dot(cross(p, q), r); };
  const Integer parts[] = {volume(b, c, d), -volume(a, c, d), volume(a, b, d), -volume(a, b, c)};
  Integer sum = 0;
  for (const Integer part : parts) sum += part;
  if (sum == 0) return false;
  return std::all_of(std::begin(parts), std::end(parts),
                     [&](Integer part) { return sum > 0 ? part >= 0 : part <= 0; });
}

using Corners = std::vector<Vector>;

bool expected_to_meet(const Corners& s, const Corners& t) {
  std::vector<Vector> points;
  for (const Vector& p : s)
    for (const Vector& q : t) points.push_back(q - p);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_zero(points[i])) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (within(points[i], points[j])) return true;
      for (std::size_t k = 0; k < j; ++k) {
        if (within(points[i], points[j], points[k])) return true;
        for (std::size_t l = 0; l < k; ++l)
          if (within(points[i], points[j], points[k], points[l])) return true;
      }
    }
  }
  return false;
}

double real(Integer value, double scale) {
  return static_cast<double>(value) * scale;
}
Point2 flat(const Vector& v, double scale) {
  return {real(v.x, scale), real(v.y, scale)};
}
Point3 solid(const Vector& v, double scale) {
  return {real(v.x, scale), real(v.y, scale), real(v.z, scale)};
}
Segment2 segment(const Corners& c, double scale = 1) {
  return {flat(c[0], scale), flat(c[1], scale)};
}
Triangle2 triangle_2d(const Corners& c, double scale = 1) {
  return {flat(c[0], scale), flat(c[1], scale), flat(c[2], scale)};
}
Triangle3 triangle_3d(const Corners& c, double scale = 1) {
  return {solid(c[0], scale), solid(c[1], scale), solid(c[2], scale)};
}

std::string text(const Corners& corners) {
  std::string result;
  for (const Vector& v : corners)
    result += '(' + std::to_string(static_cast<std::int64_t>(v.x)) + ' ' +
              std::to_string(static_cast<std::int64_t>(v.y)) + ' ' +
              std::to_string(static_cast<std::int64_t>(v.z)) + ')';
  return result;
}

/// Every set of `count` corners, repetitions included, on a grid.
std::vector<Corners> all_corner_sets(int width, int height, int depth, std::size_t count) {
  std::vector<Vector> grid;
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < height; ++y)
      for (int z = 0; z < depth; ++z) grid.push_back({x, y, z});
  std::vector<Corners> sets = {{}};
  std::vector<std::size_t> last = {0};
  for (std::size_t n = 0; n < count; ++n) {
    std::vector<Corners> longer;
    std::vector<std::size_t> longer_last;
    for (std::size_t s = 0; s < sets.size(); ++s)
      for (std::size_t g = last[s]; g < grid.size(); ++g) {
        longer.push_back(sets[s]);
        longer.back().push_back(grid[g]);
        longer_last.push_back(g);
      }
    sets = std::move(longer);
    last = std::move(longer_last);
  }
  return sets;
}

/// All pairs of sets of corners meet as the slow method says.
template <class Meet>
void expect_every_pair(const std::vector<Corners>& sets, std::size_t count, Meet meet) {
  ASSERT_EQ(sets.size(), count);
  for (const Corners& s : sets)
    for (const Corners& t : sets) ASSERT_EQ(meet(s, t), expected_to_meet(s, t)) << text(s) << text(t);
}

TEST(Segments, EveryPairOnAGrid) {
  expect_every_pair(all_corner_sets(4, 4, 1, 2), 136,
                    [](const auto& s, const auto& t) { return segments_meet(segment(s), segment(t)); });
}

TEST(TrianglesOnTheGround, EveryPairOnAGrid) {
  expect_every_pair(all_corner_sets(3, 3, 1, 3), 165, [](const auto& s, const auto& t) {
    return triangles_meet(triangle_2d(s), triangle_2d(t));
  });
}

TEST(TrianglesInSpace, EveryPairOnACube) {
  expect_every_pair(all_corner_sets(2, 2, 2, 3), 120, [](const auto& s, const auto& t) {
    return triangles_meet(triangle_3d(s), triangle_3d(t));
  });
}

TEST(TrianglesInSpace, EveryPairInAPlaneEqualsTheTestOnTheGround) {
  for (const Corners& s : all_corner_sets(3, 3, 1, 3))
    for (const Corners& t : all_corner_sets(3, 3, 1, 3)) {
      const auto tilted = [](const Corners& corners) {
        Triangle3 result = triangle_3d(corners);
        for (Point3& p : result) p = {p.y - p.x, 2 * p.x, 3 * p.y + p.x};
        return result;
      };
      ASSERT_EQ(triangles_meet(tilted(s), tilted(t)), triangles_meet(triangle_2d(s), triangle_2d(t)))
          << text(s) << text(t);
    }
}

/// Random corners on a small grid, so that touching, flat and repeated corners are common, then blown up by
/// 2^29 and, in half of the cases, some corners moved by a unit or two: slivers, and gaps of 2e-9.
class RandomCorners : public testing::TestWithParam<std::uint64_t> {
 protected:
  test::Random random{GetParam()};

  Corners corners(std::size_t count, int depth) {
    Corners result;
    for (std::size_t i = 0; i < count; ++i) {
      const auto coordinate = [&](std::uint32_t bound) {
        Integer value = static_cast<Integer>(random.below(bound)) << 29;
        if (random.below(2) == 0) value += static_cast<Integer>(random.below(5)) - 2;
        return value;
      };
      result.push_back({coordinate(4), coordinate(4), depth > 1 ? coordinate(4) : 0});
    }
    return result;
  }
};

TEST_P(RandomCorners, OnTheGround) {
  for (std::uint32_t i = 0; i < test::samples(500'000); ++i) {
    const std::size_t count = i % 5 < 3 ? 2 : 3;
    const Corners s = corners(count, 1), t = corners(count, 1);
    const bool meet = count == 2 ? segments_meet(segment(s, 0x1p-29), segment(t, 0x1p-29))
                                 : triangles_meet(triangle_2d(s, 0x1p-29), triangle_2d(t, 0x1p-29));
    ASSERT_EQ(meet, expected_to_meet(s, t)) << "case " << i << ": " << text(s) << text(t);
  }
}

TEST_P(RandomCorners, TrianglesInSpaceInAnyOrderOfCorners) {
  for (std::uint32_t i = 0; i < test::samples(200'000); ++i) {
    Corners s = corners(3, 4), t = corners(3, 4);
    const bool expected = expected_to_meet(s, t);
    for (int order = 0; order < 4; ++order) {
      ASSERT_EQ(triangles_meet(triangle_3d(s, 0x1p-29), triangle_3d(t, 0x1p-29)), expected)
          << "case " << i << ": " << text(s) << text(t);
      std::swap(s[random.below(3)], s[random.below(3)]);
      std::swap(s, t);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomCorners, testing::Values(1, 2, 3));

/// Far from the origin and far below the unit the determinants cancel completely.
TEST(Orientation, DecidesTheLastBit) {
  const double one = 1, next = 1 + 0x1p-52, half = 0.5, tiny = 0x1p-150;
  EXPECT_EQ(orientation(Point2{half, half}, Point2{12, 12}, Point2{24, 24}), 0);
  EXPECT_EQ(orientation(Point2{half, half}, Point2{12, 12}, Point2{24, 24 + 0x1p-48}), 1);
  EXPECT_EQ(orientation(Point2{half, half + 0x1p-53}, Point2{12, 12}, Point2{24, 24}), 1);
  EXPECT_EQ(orientation(Point2{0, 0}, Point2{one, next}, Point2{next, one}), -1);
  EXPECT_EQ(orientation(Point2{0, 0}, Point2{tiny, tiny}, Point2{1, 1}), 0);
  EXPECT_EQ(orientation(Point2{0, tiny}, Point2{1, 1}, Point2{2, 2}), 1);
  const Point3 a{1e6, 0, 0}, b{0, 1e6, 0}, c{0, 0, 1e6};
  EXPECT_EQ(orientation(a, b, c, Point3{1e6 / 2, 1e6 / 4, 1e6 / 4}), 0);
  EXPECT_EQ(orientation(a, b, c, Point3{1e6 / 2, 1e6 / 4, 1e6 / 4 + 0x1p-34}), 1);
  EXPECT_EQ(orientation(a, b, c, Point3{1e6 / 2, 1e6 / 4 - 0x1p-34, 1e6 / 4}), -1);
}

}  // namespace
}  // namespace bch::baselines
