// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/touching_scene.hpp"

#include "layout/base/rounding.hpp"

namespace bch::test {

baselines::Oracle oracle(const std::vector<Shape>& shapes, const Agents& agents, Pair pair) {
  return baselines::Oracle(shapes[agents.shape[pair.first]].outline,
                           shapes[agents.shape[pair.second]].outline,
                           baselines::exact_placement(agents, pair.first, pair.second));
}

std::vector<Shape> simple_shapes(Random& random, std::uint32_t count) {
  std::vector<Shape> shapes;
  while (shapes.size() < count) {
    const double size = std::pow(10.0, random.uniform(-3, 2));
    const double x = random.below(2) * random.uniform(-10, 10) * size,
                 y = random.below(2) * random.uniform(-10, 10) * size;
    const auto point = [&] {
      return Vec2{static_cast<float>(x + random.uniform(-size, size)),
                  static_cast<float>(y + random.uniform(-size, size))};
    };
    Outline outline;
    switch (random.below(4)) {
      case 0:
        outline = polygon({point(), point()});
        break;  // there and back
      case 1:
        outline = counter_clockwise(polygon({point(), point(), point()}));
        break;
      case 2:
        outline = star(random, 3 + random.below(6), 0.2 * size, size, x, y);
        break;
      default:
        outline = counter_clockwise(polygon({point(), point(), point()}));
        append(outline, polygon({point()}));
        append(outline, counter_clockwise(polygon({point(), point(), point()})));
    }
    const double threshold = size * std::pow(2.0, -1.0 - random.below(6));
    shapes.push_back(contour_shape(outline, static_cast<float>(threshold)));
  }
  return shapes;
}

TouchingScene touching_scene(Random& random, const std::vector<Shape>& shapes, std::uint32_t count) {
  TouchingScene scene;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto shape = [&] { return random.below(static_cast<std::uint32_t>(shapes.size())); };
    const std::uint32_t a = shape(), b = shape();
    const double max_extents = shapes[a].hierarchy.max_extent + shapes[b].hierarchy.max_extent;
    const double turn = random.uniform(0, 2 * std::numbers::pi), c = std::cos(turn), s = std::sin(turn);
    const double at_x = random.uniform(-1, 1) * max_extents * 1e3,
                 at_y = random.uniform(-1, 1) * max_extents * 1e3;
    const auto heading = [&] {
      return random.below(4) == 0 ? 0.5 * std::numbers::pi * random.below(4) : random.uniform(-9, 9);
    };
    Crowd two;
    two.add({a, at_x, at_y, heading(), 0});
    two.add({b, at_x + 3 * max_extents * c, at_y + 3 * max_extents * s, heading(), 0});
    const double beside = random.uniform(-1, 1) * max_extents;
    two.x[1] -= beside * s, two.y[1] += beside * c;
    // The first one's way towards it, in its own frame: the oracle moves that one.
    const double frame_c = std::cos(two.heading[0]), frame_s = std::sin(two.heading[0]);
    const long double x = 6 * max_extents * (frame_c * c + frame_s * s),
                      y = 6 * max_extents * (frame_c * s - frame_s * c);
    const long double time = oracle(shapes, two.agents(), {0, 1}).time_of_impact(x, y);
    if (!std::isfinite(time)) continue;
    const double gap = (random.below(3) == 0   ? 0
                        : random.below(2) == 0 ? 1
                                               : -1) *
                       max_extents * std::pow(10.0, random.uniform(-10, -3));
    const double way = static_cast<double>(6 * static_cast<long double>(max_extents) * time) - gap;
    two.x[1] -= way * c, two.y[1] -= way * s;
    const baselines::Oracle exact = oracle(shapes, two.agents(), {0, 1});
    const double steps =
        static_cast<double>(shapes[a].outline.grid_step) + static_cast<double>(shapes[b].outline.grid_step);
    const double beyond =
        static_cast<double>(exact.distance()) - detail::rounding::outline_grid_steps * steps;
    scene.truths.push_back({exact.cross(), beyond / max_extents});
    const auto first = static_cast<std::uint32_t>(scene.crowd.shape.size());
    for (const std::size_t k : {0, 1}) scene.crowd.add({two.shape[k], two.x[k], two.y[k], two.heading[k], 0});
    scene.pairs.push_back(i % 2 == 0 ? Pair{first, first + 1} : Pair{first + 1, first});
  }
  return scene;
}

}  // namespace bch::test
