// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosing_disc/enclosing_disc.hpp"

#include "baselines/welzl.hpp"
#include "layout/enclosing_disc/enclosing_discs.hpp"
#include "layout/format/contours.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

double distance(double x, double y, Vec2 p) {
  return std::hypot(x - static_cast<double>(p.x), y - static_cast<double>(p.y));
}

double radius_about(double x, double y, const std::vector<Vec2>& points) {
  double radius = 0;
  for (const Vec2& p : points) radius = std::max(radius, distance(x, y, p));
  return radius;
}

/// By trying every disc that two or three of the points define.
double smallest_radius(const std::vector<Vec2>& points) {
  double best = points.size() == 1 ? 0 : HUGE_VAL;
  const auto offer = [&](double x, double y) {
    if (std::isfinite(x) && std::isfinite(y)) best = std::min(best, radius_about(x, y, points));
  };
  for (const Vec2& a : points)
    for (const Vec2& b : points) {
      const double ax = a.x, ay = a.y, bx = b.x, by = b.y;
      offer((ax + bx) / 2, (ay + by) / 2);
      for (const Vec2& c : points) {
        const double cx = c.x, cy = c.y, d = 2 * (ax * (by - cy) + bx * (cy - ay) + cx * (ay - by));
        const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
        offer((a2 * (by - cy) + b2 * (cy - ay) + c2 * (ay - by)) / d,
              (a2 * (cx - bx) + b2 * (ax - cx) + c2 * (bx - ax)) / d);
      }
    }
  return best;
}

void expect_smallest(const std::vector<Vec2>& points) {
  const detail::EnclosingDisc disc = detail::smallest_enclosing_disc(points);
  EXPECT_DOUBLE_EQ(disc.radius, radius_about(disc.centre.x, disc.centre.y, points))
      << points.size() << " points";
  EXPECT_NEAR(disc.radius, smallest_radius(points), 2e-7 * detail::reach(points))
      << points.size() << " points";
}

TEST(EnclosingDisc, Examples) {
  expect_smallest({{3, 4}});
  expect_smallest({{0, 0}, {2, 0}});
  expect_smallest({{0, 0}, {2, 0}, {1, 0.5f}});
  expect_smallest({{0, 0}, {2, 0}, {1, 2}});
  EXPECT_EQ(detail::smallest_enclosing_disc(std::vector<Vec2>{{0, 0}, {2, 0}}).radius, 1);
}

TEST(EnclosingDisc, DegeneratePointSets) {
  expect_smallest(std::vector<Vec2>(5, {1, 2}));
  expect_smallest({{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0.5f, 0.5f}});
  expect_smallest({{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}});
  expect_smallest({{0, 0}, {1, 1e-7f}, {2, 0}, {1, -1e-7f}});
}

TEST(EnclosingDisc, RandomPointSets) {
  test::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vec2> points(1 + random.below(12));
    const double flat = random.below(3) == 0 ? 1e-4 : 1.0;
    for (Vec2& p : points)
      p = {static_cast<float>(random.uniform(-1, 1)), static_cast<float>(flat * random.uniform(-1, 1))};
    expect_smallest(points);
  }
}

TEST(EnclosingDisc, CocircularPointsOnTheGrid) {
  test::Random random(2);
  for (int i = 0; i < 500; ++i) {
    std::vector<Vec2> points;
    for (int k = 0; k < 12; ++k) {
      const double angle = random.uniform(-4, 4);
      points.push_back({static_cast<float>(std::round(1000 * std::cos(angle))),
                        static_cast<float>(std::round(1000 * std::sin(angle)))});
    }
    expect_smallest(points);
  }
}

/// Sets of every size and kind: on a line, on a circle, few distinct points, anywhere.
struct PointSets {
  std::vector<Vec2> points;
  std::vector<detail::PointRange> ranges;

  std::vector<Vec2> set(std::size_t i) const {
    return {points.begin() + ranges[i].begin, points.begin() + ranges[i].end};
  }
};
PointSets random_sets(test::Random& random, double scale) {
  PointSets sets;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const std::uint32_t begin = static_cast<std::uint32_t>(sets.points.size()),
                        size = 1 + random.below(i % 50 == 0 ? 300 : 12);
    for (std::uint32_t k = 0; k < size; ++k) {
      double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
      if (i % 4 == 0) y = 0.5 * x;
      if (i % 4 == 1) x = std::cos(4 * x), y = std::sqrt(1 - x * x);
      if (i % 4 == 2) x = std::round(2 * x), y = std::round(2 * y);
      sets.points.push_back({static_cast<float>(scale * x), static_cast<float>(scale * y)});
    }
    sets.ranges.push_back({begin, begin + size});
  }
  return sets;
}

TEST(EnclosingDiscs, HoldTheirPointsAndAreAsSmallAsWelzls) {
  test::Random random(3);
  bench::Welzl welzl;
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const PointSets sets = random_sets(random, scale);
    std::vector<detail::SolvedDisc> discs(sets.ranges.size());
    detail::EnclosingDiscs().solve(sets.points, sets.ranges, discs);
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const std::vector<Vec2> points = sets.set(i);
      const double radius = std::sqrt(discs[i].square_radius);
      EXPECT_DOUBLE_EQ(radius, radius_about(discs[i].centre.x, discs[i].centre.y, points));
      const double smallest = std::sqrt(welzl(points).square_radius);
      ASSERT_LE(radius, (1 + 1e-6) * smallest + 0x1p-24 * detail::reach(points))
          << points.size() << " points";
      EXPECT_NEAR(radius, detail::smallest_enclosing_disc(points).radius, 0x1p-24 * detail::reach(points));
    }
  }
}

TEST(EnclosingDiscs, AreTheSameBitsOnEveryInstructionSet) {
  test::Random random(4);
  const PointSets sets = random_sets(random, 1);
  std::vector<detail::SolvedDisc> expected(sets.ranges.size());
  detail::EnclosingDiscs(detail::build_implementations().back()).solve(sets.points, sets.ranges, expected);
  for (const detail::BuildImplementation& implementation : detail::build_implementations()) {
    if (!implementation.supported()) continue;
    std::vector<detail::SolvedDisc> discs(sets.ranges.size());
    detail::EnclosingDiscs(implementation).solve(sets.points, sets.ranges, discs);
    for (std::size_t i = 0; i < discs.size(); ++i) {
      ASSERT_EQ(discs[i].centre, expected[i].centre) << implementation.name << ", set " << i;
      ASSERT_EQ(discs[i].square_radius, expected[i].square_radius) << implementation.name << ", set " << i;
    }
  }
}

}  // namespace
}  // namespace bch
