// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdio>
#include <vector>

#include <bch/outline.hpp>
#include <bch/pairs.hpp>
#include <bch/shapes.hpp>

// Footprints: bodies that come from no mesh. A person with a trolley, and a pillar, by their polygons on the ground.

int main() {
  const std::vector<std::vector<bch::Vec2>> with_trolley = {
      {{-0.15f, -0.25f}, {0.15f, -0.25f}, {0.15f, 0.25f}, {-0.15f, 0.25f}},
      {{0.4f, -0.3f}, {1.2f, -0.3f}, {1.2f, 0.3f}, {0.4f, 0.3f}}};
  const std::vector<std::vector<bch::Vec2>> pillar = {{{0.3f, 0}, {0, 0.3f}, {-0.3f, 0}, {0, -0.3f}}};

  std::vector<bch::Shape> shapes;
  for (const auto& polygons : {with_trolley, pillar}) {
    bch::Outline outline = bch::outline_from_polygons(polygons);
    bch::Hierarchy hierarchy = bch::contour_hierarchy(outline, 0.02f);
    shapes.push_back({std::move(outline), std::move(hierarchy)});
  }
  const bch::ShapeSet set(shapes);

  // The first one has the pillar in the gap between person and trolley and does not touch it; the second one runs the trolley
  // into it.
  const std::vector<std::uint32_t> shape = {0, 0, 1};
  const std::vector<double> x = {-1, -2, -0.73}, y = {0, 0.4, 0.62}, heading = {0, 0.1, 0};
  const std::vector<bch::Pair> pairs = {{0, 2}, {1, 2}};
  std::vector<std::uint8_t> hits(pairs.size());
  bch::collide(set, {shape, x, y, heading}, pairs, hits);
  std::vector<float> distance(pairs.size());
  bch::clearance(set, {shape, x, y, heading}, pairs, {distance});
  for (std::size_t i = 0; i < pairs.size(); ++i)
    std::printf("person %zu %s the pillar (%.2f m)\n", i, hits[i] ? "hits" : "passes",
                static_cast<double>(distance[i]));
  return hits[0] == 0 && hits[1] == 1 ? 0 : 1;
}
