// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/obstacle_scenes.hpp"

namespace bch::test {
namespace {

using Point = ObstacleScene::Point;

/// A ring about a point, star-shaped, of so many corners.
std::vector<Point> ring(Random& random, Point centre, double radius, std::uint32_t corners) {
  std::vector<Point> points;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, r = radius * random.uniform(0.6, 1);
    points.push_back({centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)});
  }
  return points;
}

}  // namespace

void ObstacleScene::add_polyline(const std::vector<Point>& points, bool is_ring) {
  for (const Point& point : points) x.push_back(point.x), y.push_back(point.y);
  polyline_offsets.push_back(x.size());
  const auto add = [&](const Point& a, const Point& b) { open_.segments.push_back({a.x, a.y, b.x, b.y}); };
  for (std::size_t i = 1; i < points.size(); ++i) add(points[i - 1], points[i]);
  const Point &first = points.front(), &last = points.back();
  if (points.size() == 1 || (is_ring && (first.x != last.x || first.y != last.y))) add(last, first);
}

void ObstacleScene::end_obstacle(bool area) {
  obstacle_offsets.push_back(polyline_offsets.size() - 1);
  is_area.push_back(area);
  open_.is_area = area;
  reference.push_back(open_);
  open_ = {};
}

ObstacleScene ObstacleScene::part(std::span<const std::uint32_t> obstacles) const {
  ObstacleScene some;
  for (const std::uint32_t obstacle : obstacles) {
    const bool area = is_area[obstacle] != 0;
    for (auto p = obstacle_offsets[obstacle]; p < obstacle_offsets[obstacle + 1]; ++p) {
      std::vector<Point> points;
      for (auto i = polyline_offsets[p]; i < polyline_offsets[p + 1]; ++i) points.push_back({x[i], y[i]});
      some.add_polyline(points, area);
    }
    some.end_obstacle(area);
  }
  return some;
}

ObstacleScene obstacle_scene(Random& random, std::uint32_t count, double half, double x, double y) {
  ObstacleScene scene;
  const auto coordinate = [&](double middle) {
    // Many on a grid, so that ends, lines and vertices fall together.
    const double value = random.uniform(-half, half);
    return middle + (random.below(2) == 0 ? std::round(4 * value) / 4 : value);
  };
  const auto point = [&] {
    const double px = coordinate(x);
    return Point{px, coordinate(y)};
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point at = point();
    switch (random.below(8)) {
      case 0: {  // a wall of several pieces, some without length
        std::vector<Point> path{at};
        for (std::uint32_t k = 1 + random.below(4); k > 0; --k)
          path.push_back(random.below(5) == 0 ? path.back() : point());
        scene.add(path, false);
        break;
      }
      case 1:  // collinear pieces that overlap
        scene.add({at, {at.x + 1, at.y}, {at.x + 0.5, at.y}, {at.x + 2, at.y}}, false);
        break;
      case 2:  // a post without extent
        scene.add({at}, false);
        break;
      case 3: {  // the same twice
        const Point to = point();
        for (int k = 0; k < 2; ++k) scene.add({at, to}, false);
        break;
      }
      case 4: {  // a polygon with a hole, and something in that
        const double radius = random.uniform(0.3, 2);
        scene.add_polyline(ring(random, at, radius, 3 + random.below(8)), true);
        scene.add_polyline(ring(random, at, 0.5 * radius, 3 + random.below(5)), true);
        if (random.below(2) == 0) scene.add_polyline(ring(random, at, 0.2 * radius, 4), true);
        scene.end_obstacle(true);
        break;
      }
      case 5:  // one that crosses itself
        scene.add({at, {at.x + 1, at.y + 1}, {at.x + 1, at.y}, {at.x, at.y + 1}}, true);
        break;
      case 6:  // a square, and the same as an obstacle of its own, closed by its points
        for (int k = 0; k < 2; ++k) {
          scene.add({at, {at.x + 0.5, at.y}, {at.x + 0.5, at.y + 0.5}, {at.x, at.y + 0.5}, at}, true);
        }
        break;
      default:  // a pillar
        scene.add(ring(random, at, random.uniform(0.05, 0.4), 3 + random.below(6)), true);
    }
  }
  return scene;
}

Crowd crowd_about(Random& random, const ShapeSet& shapes, std::uint32_t count, double half, double x,
                  double y) {
  Crowd crowd;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double at_x = random.uniform(-half, half), at_y = random.uniform(-half, half);
    crowd.add({random.below(shapes.shape_count()),
               x + (random.below(3) == 0 ? std::round(4 * at_x) / 4 : at_x),
               y + (random.below(3) == 0 ? std::round(4 * at_y) / 4 : at_y),
               random.below(4) == 0 ? 0 : random.uniform(-4, 4),
               static_cast<std::uint8_t>(random.below(shapes.level_count()))});
  }
  return crowd;
}

}  // namespace bch::test
