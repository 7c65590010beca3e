// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/trial.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <bch/outline_builder.hpp>

#include "layout/format/contours.hpp"

namespace bch::bench {
namespace {

using detail::Random;

using std::numbers::pi;

Vec2 point(double x, double y) {
  return {static_cast<float>(x), static_cast<float>(y)};
}

Specimen specimen(Outline outline, Outline geometry, double threshold) {
  Shape shape{std::move(outline), {}};
  shape.hierarchy = contour_hierarchy(shape.outline, static_cast<float>(threshold));
  baselines::ExactCut discs = baselines::exact_cut(shape.hierarchy, all_depths);
  return {std::move(shape), std::move(discs), std::move(geometry)};
}

/// Returns the grid step that snap_to_grid() chooses.
double grid_step(std::span<const Vec2> points) {
  double largest = 0;
  for (const Vec2 p : points)
    largest = std::max({largest, std::abs(static_cast<double>(p.x)), std::abs(static_cast<double>(p.y))});
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, exponent - 23);
}

/// A needle has two corners a millionth of its length apart; folded triangles share an edge and lie on each other.
std::vector<Vec2> soup(Random& random, Soup kind) {
  std::vector<Vec2> corners;
  const auto place = [&] { return point(random.between(-0.3, 0.3), random.between(-0.3, 0.3)); };
  for (int i = 0; i < 6; ++i) {
    const Vec2 a = place(), b = place(), c = place();
    const float t = static_cast<float>(random.between(-0.5, 1.5));
    switch (kind) {
      case Soup::collinear:
        corners.insert(corners.end(), {a, b, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}});
        break;
      case Soup::duplicate:
        corners.insert(corners.end(), {a, b, c, b, c, a, a, c, b, a, a, b});
        break;
      case Soup::folded:
        corners.insert(corners.end(), {a, b, c, b, a, {c.x + 1e-6f * t, c.y - 1e-6f}});
        break;
      case Soup::needle:
        corners.insert(corners.end(), {a, {a.x + 1e-6f, a.y + 1e-7f * t}, b});
    }
  }
  return corners;
}

}  // namespace

Specimen raw_specimen(std::vector<Vec2> points, double threshold) {
  Outline outline;
  outline.contour_begin.push_back(static_cast<std::uint32_t>(points.size()));
  outline.points = std::move(points);
  return specimen(outline, outline, threshold);
}

Specimen contour_specimen(std::vector<Vec2> points, double threshold) {
  const double step = grid_step(points);
  const auto on_grid = [step](float value) {
    return std::floor(static_cast<double>(value) / step + 0.5) * step;
  };
  Outline outline;
  for (const Vec2 p : points) outline.points.push_back(point(on_grid(p.x), on_grid(p.y)));
  outline.contour_begin.push_back(static_cast<std::uint32_t>(points.size()));
  outline.grid_step = static_cast<float>(step);
  return specimen(outline, outline, threshold);
}

Specimen triangle_specimen(const std::vector<Vec2>& corners, double threshold) {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Outline geometry;
  geometry.points = corners;
  for (std::uint32_t i = 0; i < corners.size(); i += 3) {
    for (std::uint32_t k = i; k < i + 3; ++k) positions.push_back({corners[k].x, corners[k].y, 0});
    triangles.push_back({i, i + 1, i + 2});
    geometry.contour_begin.push_back(i + 3);
  }
  return specimen(bch::outline(positions, triangles), std::move(geometry), threshold);
}

std::vector<Vec2> ring(Random& random, std::uint32_t corners, double inner, double outer, double x, double y,
                       double slenderness) {
  std::vector<Vec2> points;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * pi * (i + random.between(-0.4, 0.4)) / corners,
                 radius = random.between(inner, outer);
    points.push_back(point(x + radius * std::cos(angle), y + radius * std::sin(angle) / slenderness));
  }
  return points;
}

std::vector<Specimen> usual_specimens(Random& random, double max_extent) {
  std::vector<Specimen> specimens;
  const auto add = [&](std::vector<Vec2> points, double threshold) {
    const double factor = max_extent / detail::max_extent(points);
    for (Vec2& p : points) p = point(factor * static_cast<double>(p.x), factor * static_cast<double>(p.y));
    specimens.push_back(contour_specimen(std::move(points), threshold * max_extent));
  };
  for (int i = 0; i < 4; ++i) {
    const double x = random.between(-1, 1), y = random.between(-1, 1);
    add(ring(random, 3, 0.1, 0.4), 0.1);
    add(ring(random, 24, 0.2, 0.4), 0.1);
    add(ring(random, 12, 0.1, 0.3, x, y), 0.1);
    add({point(x, y), point(y, -x)}, 9);
  }
  return specimens;
}

std::vector<Specimen> prism_specimens(Random& random) {
  std::vector<Specimen> specimens = usual_specimens(random, 1);
  for (Specimen& prism : specimens) {
    const double bottom = random.uniform(1);
    prism.shape.heights = {static_cast<float>(bottom), static_cast<float>(bottom + random.between(1, 2))};
  }
  return specimens;
}

std::vector<Specimen> soup_specimens(Random& random, Soup kind) {
  std::vector<Specimen> specimens;
  for (int i = 0; i < 12; ++i) specimens.push_back(triangle_specimen(soup(random, kind), 0.02));
  return specimens;
}

}  // namespace bch::bench
