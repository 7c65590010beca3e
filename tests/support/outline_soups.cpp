// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/outline_soups.hpp"

namespace bch::test {
namespace {

constexpr float unit = 0x1p-10f;  ///< metres

IntegerPoint steps(float x, float y, float grid_step) {
  return {static_cast<std::int64_t>(x / grid_step), static_cast<std::int64_t>(y / grid_step)};
}

struct Corner {
  std::int32_t x, y;
};

void add(Soup& soup, Corner a, Corner b, Corner c) {
  const auto first = static_cast<std::uint32_t>(soup.positions.size());
  for (const Corner corner : {a, b, c})
    soup.positions.push_back({unit * static_cast<float>(corner.x), unit * static_cast<float>(corner.y), 0});
  soup.triangles.push_back({first, first + 1, first + 2});
}

void add_quadrilateral(Soup& soup, Corner a, Corner b, Corner c, Corner d) {
  add(soup, a, b, c);
  add(soup, a, c, d);
}

/// A frame between two triangles with sides along the axes.
void add_frame(Soup& soup, Corner at, std::int32_t outer, std::int32_t width) {
  const Corner a = at, b{at.x + outer, at.y}, c{at.x, at.y + outer};
  const Corner u{at.x + width, at.y + width}, v{at.x + outer - 3 * width, u.y},
      w{u.x, at.y + outer - 3 * width};
  add_quadrilateral(soup, a, b, v, u);
  add_quadrilateral(soup, b, c, w, v);
  add_quadrilateral(soup, c, a, u, w);
}

void add_nest(Soup& soup, Corner at, std::uint32_t depth) {
  constexpr std::int32_t width = 2, gap = 2, shrink = 5 * (width + gap);
  std::int32_t size = shrink * static_cast<std::int32_t>(depth) + 2;
  for (std::uint32_t i = 0; i < depth; ++i, size -= shrink) {
    add_frame(soup, at, size, width);
    at = {at.x + width + gap, at.y + width + gap};
  }
  add(soup, at, {at.x + 1, at.y}, {at.x, at.y + 1});
}

/// Triangles with corners anywhere, many at the same places.
Soup anywhere(Random& random) {
  const auto corner = [&] {
    return Corner{static_cast<std::int32_t>(random.below(20)), static_cast<std::int32_t>(random.below(20))};
  };
  Soup soup;
  for (std::uint32_t left = 1 + random.below(12); left > 0; --left) add(soup, corner(), corner(), corner());
  return soup;
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

Soup separate_triangles(std::uint32_t count) {
  const auto row = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
  Soup soup;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Corner at{static_cast<std::int32_t>(4 * (i % row)), static_cast<std::int32_t>(4 * (i / row))};
    add(soup, at, {at.x + 2, at.y}, {at.x, at.y + 2});
  }
  return soup;
}

Soup nested_frames(std::uint32_t count, std::uint32_t depth) {
  const auto pitch = static_cast<std::int32_t>(20 * depth + 10);
  Soup soup;
  for (std::uint32_t i = 0; i < count; ++i)
    add_nest(soup, {pitch * static_cast<std::int32_t>(i % 64), pitch * static_cast<std::int32_t>(i / 64)},
             depth);
  return soup;
}

Soup comb(std::uint32_t teeth, bool before) {
  const auto end = static_cast<std::int32_t>(12 * teeth);
  Soup soup;
  add_quadrilateral(soup, {0, 40}, {end, 40}, {end, 42}, {0, 42});
  for (std::int32_t x = 0; x < end; x += 12) {
    add(soup, {x, 40}, {x + 8, 40}, {x + 4, 0});
    add(soup, {x + 4, 30}, {x + 5, 30}, {x + 4, 32});
    add(soup, {x + 9, 10}, {x + 11, 10}, {x + 10, 12});
  }
  if (before) add(soup, {-9, 0}, {-5, 0}, {-7, 4});
  return soup;
}

Soup wheel(std::uint32_t triangles, bool before) {
  constexpr double radius = 2000;
  const auto rim = [&](std::uint32_t i) {
    const double angle = 6.283185307179586 * i / triangles;
    return Corner{static_cast<std::int32_t>(std::lround(radius * std::cos(angle))),
                  static_cast<std::int32_t>(std::lround(radius * std::sin(angle)))};
  };
  Soup soup;
  for (std::uint32_t i = 0; i < triangles; ++i) add(soup, {0, 0}, rim(i), rim((i + 1) % triangles));
  for (std::int32_t y = -1000; y <= 1000; y += 77) add(soup, {3, y}, {5, y}, {3, y + 2});
  if (before) add(soup, {-2009, 0}, {-2005, 0}, {-2007, 4});
  return soup;
}

Soup chain(std::uint32_t count) {
  Soup soup;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto x = static_cast<std::int32_t>(4 * i);
    add(soup, {x, i % 2 == 0 ? 0 : 1}, {x + 4, i % 2 == 0 ? 1 : 0}, {x + 2, 3});
  }
  return soup;
}

Soup nearly_equal_triangles(Random& random, std::uint32_t count, std::uint32_t spread) {
  const auto near = [&](std::int32_t value) {
    return value + static_cast<std::int32_t>(random.below(spread));
  };
  Soup soup;
  for (std::uint32_t i = 0; i < count; ++i)
    add(soup, {near(0), near(0)}, {near(900), near(100)}, {near(300), near(700)});
  return soup;
}

void append(Soup& soup, const Soup& other, std::int32_t x, std::int32_t y) {
  const auto first = static_cast<std::uint32_t>(soup.positions.size());
  for (const Vec3& p : other.positions)
    soup.positions.push_back({p.x + unit * static_cast<float>(x), p.y + unit * static_cast<float>(y), p.z});
  for (const auto& [a, b, c] : other.triangles) soup.triangles.push_back({a + first, b + first, c + first});
}

Soup jumble(Random& random) {
  const auto place = [&] { return static_cast<std::int32_t>(random.below(120)); };
  Soup soup;
  for (std::uint32_t left = 1 + random.below(4); left > 0; --left) {
    const std::uint32_t kind = random.below(5);
    const Soup part = kind == 0   ? separate_triangles(1 + random.below(9))
                      : kind == 1 ? nested_frames(1, 1 + random.below(3))
                      : kind == 2 ? comb(1 + random.below(3), random.below(2) == 0)
                      : kind == 3 ? chain(1 + random.below(6))
                                  : anywhere(random);
    const std::int32_t x = place(), y = place();
    append(soup, part, x, y);
  }
  return soup;
}

}  // namespace bch::test
