// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/cut_soups.hpp"

namespace bch::test {
namespace {

struct Point {
  long double x, y, z;
};

/// What of a convex polygon lies below a height (sign 1) or above it (-1), half a float step above its number.
std::vector<Point> clipped(const std::vector<Point>& polygon, float number, int sign) {
  const long double next = std::nextafter(number, std::numeric_limits<float>::infinity()),
                    height = (number + next) / 2;
  std::vector<Point> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const bool p_in = sign * (p.z - height) < 0, q_in = sign * (q.z - height) < 0;
    if (p_in) rest.push_back(p);
    if (p_in != q_in) {
      const long double t = (height - p.z) / (q.z - p.z);
      rest.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), height});
    }
  }
  return rest;
}

}  // namespace

Soup part_between(Positions positions, Triangles triangles, const Heights& heights) {
  Soup soup;
  for (const auto& corners : triangles) {
    std::vector<Point> polygon;
    for (const std::uint32_t v : corners) polygon.push_back({positions[v].x, positions[v].y, positions[v].z});
    polygon = clipped(clipped(polygon, heights.bottom, -1), heights.top, 1);
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const Point& p : polygon)
      soup.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), 0});
    for (std::uint32_t i = 2; i < polygon.size(); ++i)
      soup.triangles.push_back({first, first + i - 1, first + i});
  }
  return soup;
}

Soup rounded(Soup soup, float grid_step) {
  for (Vec3& p : soup.positions)
    p = {std::nearbyint(p.x / grid_step) * grid_step, std::nearbyint(p.y / grid_step) * grid_step, 0};
  std::erase_if(soup.triangles, [&](const auto& corners) {
    const auto& [a, b, c] = corners;
    return soup.positions[a] == soup.positions[b] && soup.positions[a] == soup.positions[c];
  });
  return soup;
}

}  // namespace bch::test
