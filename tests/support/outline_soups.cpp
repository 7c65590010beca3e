// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/outline_soups.hpp"

namespace bch::test {
namespace {

constexpr float unit = 0x1p-10f;  ///< metres

IntegerPoint steps(float x, float y, float grid_step) {
  return {static_cast<std::int64_t>(x / grid_step), static_cast<std::int64_t>(y / grid_step)};
}

}  // namespace

Soup random_soup(Random& random) {
  constexpr std::uint32_t ranges[] = {2, 4, 5, 8, 32};
  const std::uint32_t range = ranges[random.below(5)];
  const auto coordinate = [&] { return unit * static_cast<float>(random.below(range)); };
  const auto point = [&] { return Vec3{coordinate(), coordinate(), coordinate()}; };
  Soup soup;
  const std::uint32_t count = 1 + random.below(random.below(6) == 0 ? 30 : 12);
  const bool shared = random.below(2) == 0;
  const std::uint32_t vertices = shared ? 3 + random.below(count + 4) : 3 * count;
  for (std::uint32_t v = 0; v < vertices; ++v) soup.positions.push_back(point());
  for (std::uint32_t t = 0; t < count; ++t) {
    std::array<std::uint32_t, 3> triangle = {3 * t, 3 * t + 1, 3 * t + 2};
    if (shared) {
      const bool strip = random.below(2) == 0;
      for (std::uint32_t k = 0; k < 3; ++k) triangle[k] = strip ? (t + k) % vertices : random.below(vertices);
      if (random.below(2) == 0) std::swap(triangle[0], triangle[1]);
    }
    soup.triangles.push_back(triangle);
  }
  if (random.below(2) == 0) {
    const float distant = unit * 0x1p22f;
    const std::uint32_t first = vertices;
    soup.positions.push_back({distant, coordinate(), 0});
    soup.positions.push_back({distant + coordinate(), coordinate(), 0});
    soup.positions.push_back(random.below(3) == 0 ? point() : Vec3{distant, coordinate(), 0});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

std::vector<IntegerTriangle> on_grid(const Soup& soup, float grid_step) {
  std::vector<IntegerTriangle> triangles;
  for (const auto& t : soup.triangles) {
    IntegerTriangle& triangle = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = steps(soup.positions[t[k]].x, soup.positions[t[k]].y, grid_step);
  }
  return triangles;
}

std::vector<IntegerContour> on_grid(const Outline& outline) {
  std::vector<IntegerContour> contours(outline.contours());
  for (std::size_t c = 0; c < contours.size(); ++c)
    for (const Vec2& p : outline.contour(c)) contours[c].push_back(steps(p.x, p.y, outline.grid_step));
  return contours;
}

}  // namespace bch::test
