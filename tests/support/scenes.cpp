// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/scenes.hpp"

#include "layout/format/shape_set_view.hpp"

namespace bch::test {
namespace {

constexpr double grid = 0x1p-21;
constexpr double pi = std::numbers::pi;

double on_grid(double value, double step) {
  return std::floor(value / step + 0.5) * step;
}

Outline whisker(Random& random) {
  Outline outline = star(random, 7, 0.1, 0.3);
  const Vec2 root = outline.points[3];
  const Vec2 tip{static_cast<float>(on_grid(2.0 * static_cast<double>(root.x), grid)),
                 static_cast<float>(on_grid(2.0 * static_cast<double>(root.y), grid))};
  outline.points.insert(outline.points.begin() + 4, {tip, root});
  outline.contour_begin.back() = static_cast<std::uint32_t>(outline.points.size());
  return outline;
}

Outline slender(Random& random) {
  Outline outline = star(random, 24, 0.2, 0.4);
  for (Vec2& p : outline.points) p.y = static_cast<float>(on_grid(static_cast<double>(p.y) / 64, grid));
  return outline;
}

Outline archipelago(Random& random) {
  Outline outline = star(random, 40, 0.15, 0.25);
  append(outline, star(random, 12, 0.03, 0.06, 0.4, 0.1));
  append(outline, star(random, 5, 0.02, 0.04, -0.35, 0.2));
  return outline;
}

}  // namespace

Outline polygon(std::vector<Vec2> points) {
  Outline outline;
  outline.contour_begin.push_back(static_cast<std::uint32_t>(points.size()));
  outline.points = std::move(points);
  outline.grid_step = 0x1p-20f;
  return outline;
}

Outline star(Random& random, std::uint32_t corners, double inner, double outer, double x, double y) {
  const double step = outer > 1.5 ? 8 * grid : grid;
  Outline outline;
  outline.grid_step = static_cast<float>(step);
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * pi * (i + random.uniform(-0.4, 0.4)) / corners,
                 radius = random.uniform(inner, outer);
    outline.points.push_back({static_cast<float>(on_grid(x + radius * std::cos(angle), step)),
                              static_cast<float>(on_grid(y + radius * std::sin(angle), step))});
  }
  outline.contour_begin.push_back(corners);
  return outline;
}

Outline needle() {
  const auto length = static_cast<float>(on_grid(0.4, grid)), half = static_cast<float>(4 * grid);
  return {
      .points = {{-length, -half}, {length, 0}, {-length, half}}, .contour_begin = {0, 3}, .grid_step = grid};
}

Outline counter_clockwise(Outline outline) {
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    if (area(polygon({contour.begin(), contour.end()})) >= 0) continue;
    const auto begin = outline.points.begin();
    std::reverse(begin + outline.contour_begin[c], begin + outline.contour_begin[c + 1]);
  }
  return outline;
}

void append(Outline& outline, const Outline& more) {
  for (std::size_t c = 0; c < more.contours(); ++c) {
    const auto contour = more.contour(c);
    outline.points.insert(outline.points.end(), contour.begin(), contour.end());
    outline.contour_begin.push_back(static_cast<std::uint32_t>(outline.points.size()));
  }
}

Shape contour_shape(const Outline& outline, float threshold) {
  return {outline, contour_hierarchy(outline, threshold)};
}

std::vector<Shape> synthetic_shapes(std::uint64_t seed, std::uint32_t count) {
  Random random(seed);
  std::vector<Shape> shapes;
  for (std::uint32_t i = 0; i < count; ++i) {
    switch (i % 8) {
      case 0:
        shapes.push_back(contour_shape(star(random, 3, 0.1, 0.4)));
        break;
      case 1:
        shapes.push_back(contour_shape(star(random, 300, 0.3, 0.35)));
        break;
      case 2:
        shapes.push_back(contour_shape(slender(random)));
        break;
      case 3:
        shapes.push_back(contour_shape(archipelago(random)));
        break;
      case 4:
        shapes.push_back(contour_shape(whisker(random)));
        break;
      case 5:
        shapes.push_back(contour_shape(star(random, 9, 0.005, 0.01)));
        break;
      case 6:
        shapes.push_back(contour_shape(star(random, 50, 2, 4), 0.05f));
        break;
      default:
        shapes.push_back(contour_shape(star(random, 60, 0.15, 0.45, random.uniform(-0.3, 0.3), 0.2)));
    }
  }
  return shapes;
}

Shape body_of_discs(Random& random, std::uint32_t count) {
  const double size = std::pow(10, random.uniform(-3, 1));
  const auto at = [&](double low, double high) {
    return static_cast<float>(size * random.uniform(low, high));
  };
  std::vector<Disc> discs;
  while (discs.size() < count) discs.push_back({at(-1, 1), at(-1, 1), at(0.02, 0.4)});
  return shape_from_discs(discs);
}

std::vector<Shape> repeated(std::span<const Shape> shapes) {
  std::vector<Shape> many;
  while (many.size() < 1000) many.insert(many.end(), shapes.begin(), shapes.end());
  return many;
}

void Crowd::add(const Agent& agent) {
  shape.push_back(agent.shape);
  x.push_back(agent.x);
  y.push_back(agent.y);
  heading.push_back(agent.heading);
  level.push_back(agent.level);
}

PairScene random_scene(Random& random, const ShapeSet& shapes, std::uint32_t pairs) {
  const detail::ShapeSetView view = shapes.view();
  const auto extent = [&](std::uint32_t shape) {
    const detail::Root& root = view.roots[(shape + 1) * view.level_count - 1];
    return std::hypot(static_cast<double>(root.x), static_cast<double>(root.y)) +
           static_cast<double>(root.radius);
  };
  if (pairs >= 5'000) pairs = samples(pairs);
  PairScene scene;
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const std::uint32_t a = random.below(shapes.shape_count()), b = random.below(shapes.shape_count());
    const auto level = [&] { return static_cast<std::uint8_t>(random.below(shapes.level_count())); };
    const double far = extent(a) + extent(b);
    const double angle = random.uniform(-pi, pi), distance = far * random.uniform(0, 1.1);
    const double x = on_grid(random.uniform(-50, 50), 0x1p-20), y = on_grid(random.uniform(-50, 50), 0x1p-20);
    scene.crowd.add({a, x, y, random.uniform(-10, 10), level()});
    scene.crowd.add({b, on_grid(x + distance * std::cos(angle), 0x1p-20),
                     on_grid(y + distance * std::sin(angle), 0x1p-20), random.uniform(-10, 10), level()});
    scene.pairs.push_back(random.below(2) == 0 ? Pair{2 * i, 2 * i + 1} : Pair{2 * i + 1, 2 * i});
  }
  return scene;
}

void make_tangent(Random& random, PairScene& scene, const std::function<bool(const Agents&, Pair)>& hit) {
  Crowd& crowd = scene.crowd;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const std::size_t a = 2 * i, b = 2 * i + 1;
    const double angle = random.uniform(-pi, pi), dx = std::cos(angle), dy = std::sin(angle);
    const auto hits_at = [&](double distance) {
      crowd.x[b] = crowd.x[a] + distance * dx;
      crowd.y[b] = crowd.y[a] + distance * dy;
      return hit(crowd.agents(), scene.pairs[i]);
    };
    double near = 0, far = 20;
    if (!hits_at(near))
      near = random.uniform(0, 1);  // contours beside each other: any edge of the answer will do
    for (int step = 0; step < 48; ++step) {
      const double middle = 0.5 * (near + far);
      (hits_at(middle) ? near : far) = middle;
    }
    hits_at(near + (far - near + 0x1p-26) * (static_cast<int>(random.below(9)) - 4));
  }
}

void move_away(PairScene& scene, double x, double y) {
  for (double& at : scene.crowd.x) at += x;
  for (double& at : scene.crowd.y) at += y;
}

}  // namespace bch::test
