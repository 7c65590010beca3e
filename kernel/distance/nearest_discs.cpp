// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distance/nearest_discs.hpp"

#include <cmath>
#include <cstddef>

#include "layout/base/heading.hpp"

namespace bch::detail {
namespace {

struct Vector {
  double x, y;
};

Vector line(const NearestDiscs& nearest, double sign) {
  const double x = nearest.x, y = nearest.y;
  if (x == 0 && y == 0) return {sign, 0};
  const double c = nearest.cosine, s = nearest.sine, world_x = c * x - s * y, world_y = s * x + c * y;
  const double scale = sign / std::sqrt(world_x * world_x + world_y * world_y);
  return {scale * world_x, scale * world_y};
}

/// Returns where an agent's disc, which stands at that node, goes as far as it does along a direction.
Vec2 end(const FoundDiscs& found, std::uint32_t agent, std::uint32_t node, Vector along) {
  const std::size_t root = found.agents.root(agent, found.shapes.level_count);
  Disc disc{found.shapes.roots[root].x, found.shapes.roots[root].y, found.shapes.roots[root].radius};
  if (found.shapes.trees != nullptr) {
    const std::size_t stride = found.shapes.trees[root].stride;
    const float* const x = found.shapes.nodes + node;
    disc = {x[0], x[stride], x[2 * stride]};
  }
  const double x = disc.x, y = disc.y, radius = disc.radius;
  const auto [c, s] = rotation(found.agents.heading[agent]);
  return {static_cast<float>(c * x - s * y + radius * along.x),
          static_cast<float>(s * x + c * y + radius * along.y)};
}

}  // namespace

DiscPair numbers(const FoundDiscs& found) {
  const auto number = [&](std::uint32_t agent, std::uint32_t node) {
    if (found.shapes.trees == nullptr) return node;
    return node - found.shapes.trees[found.agents.root(agent, found.shapes.level_count)].discs;
  };
  return {number(found.pair.first, found.nearest.a), number(found.pair.second, found.nearest.b)};
}

Vec2 direction(const NearestDiscs& nearest, double sign) {
  const auto [x, y] = line(nearest, sign);
  return {static_cast<float>(x), static_cast<float>(y)};
}

NearestPoints points(const FoundDiscs& found) {
  const Vector along = line(found.nearest, 1);
  return {end(found, found.pair.first, found.nearest.a, along),
          end(found, found.pair.second, found.nearest.b, {-along.x, -along.y})};
}

}  // namespace bch::detail
