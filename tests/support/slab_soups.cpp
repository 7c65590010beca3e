// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/slab_soups.hpp"

#include "layout/base/planes.hpp"

namespace bch::test {
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

}  // namespace

Soup slab_of(Positions positions, Triangles triangles, std::span<const float> planes, std::size_t slab,
             float grid_step) {
  Soup soup;
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

}  // namespace bch::test
