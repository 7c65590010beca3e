// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosing_disc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/scenes.hpp"

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
  const EnclosingDisc disc = smallest_enclosing_disc(points);
  EXPECT_DOUBLE_EQ(disc.radius, radius_about(disc.centre.x, disc.centre.y, points))
      << points.size() << " points";
  EXPECT_NEAR(disc.radius, smallest_radius(points), 2e-7 * reach(points)) << points.size() << " points";
}

TEST(EnclosingDisc, Examples) {
  expect_smallest({{3, 4}});
  expect_smallest({{0, 0}, {2, 0}});
  expect_smallest({{0, 0}, {2, 0}, {1, 0.5f}});
  expect_smallest({{0, 0}, {2, 0}, {1, 2}});
  EXPECT_EQ(smallest_enclosing_disc(std::vector<Vec2>{{0, 0}, {2, 0}}).radius, 1);
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

}  // namespace
}  // namespace bch
