// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/near_tangent.hpp"

#include <cmath>

namespace bch::test {
namespace {

using baselines::ExactDisc;
using baselines::Quad;
using baselines::QuadVector;

const ShapeSetPlan plan{{0, 2, all_depths}};

/// Its two ends lie on its smallest enclosing disc.
Outline stroke(Random& random) {
  const double far = std::exp2(random.uniform(-6, 3)), size = std::exp2(random.uniform(-10, 2));
  const double at = random.uniform(-4, 4), along = random.uniform(-4, 4);
  const double x = far * std::cos(at), y = far * std::sin(at);
  Outline outline;
  outline.points = {
      {static_cast<float>(x), static_cast<float>(y)},
      {static_cast<float>(x + size * std::cos(along)), static_cast<float>(y + size * std::sin(along))}};
  outline.contour_begin.push_back(2);
  return outline;
}

Shape tangent_shape(Random& random) {
  if (random.below(4) > 0) {
    const Outline outline = stroke(random);
    return {outline, contour_hierarchy(outline, 9.0f)};
  }
  Outline outline = star(random, 3 + random.below(8), 0.1, 0.4, random.uniform(-1, 1), random.uniform(-1, 1));
  outline.grid_step = 0;
  return {outline, contour_hierarchy(outline, 0.03f)};
}

double heading_of_any_size(Random& random) {
  const double sign = random.below(2) == 0 ? 1 : -1;
  switch (random.below(4)) {
    case 0:
      return sign * std::exp2(random.uniform(-60, 0));
    case 1:
      return sign * std::exp2(random.uniform(2, 29.8));
    default:
      return random.uniform(-4, 4);
  }
}

std::vector<Shape> make_shapes(Random& random, std::uint32_t count) {
  std::vector<Shape> shapes;
  for (std::uint32_t i = 0; i < count; ++i) shapes.push_back(tangent_shape(random));
  return shapes;
}

double extent(const ExactDisc& disc, double x, double y) {
  return static_cast<double>(disc.centre.x) * x + static_cast<double>(disc.centre.y) * y +
         static_cast<double>(disc.radius);
}

/// The disc that goes furthest along (x, y).
std::uint32_t outermost(const PosedShape& pose, double x, double y) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < pose.discs.size(); ++i)
    if (extent(pose.discs[i], x, y) > extent(pose.discs[best], x, y)) best = i;
  return best;
}

double near_gap(Random& random, double radii, double reaches) {
  switch (random.below(4)) {
    case 0:
      return (static_cast<int>(random.below(129)) - 64) * 0x1p-52 * radii;
    case 1:
      return random.uniform(-8, 8) * rounding::unit_roundoff * reaches;
    default:
      return (static_cast<int>(random.below(129)) - 64) * 0x1p-24 * radii;
  }
}

}  // namespace

TangentShapes::TangentShapes(std::uint64_t seed, std::uint32_t shapes, std::uint32_t poses)
    : shapes_([&] {
        Random random(seed);
        return make_shapes(random, shapes);
      }()),
      set_(shapes_, plan) {
  Random random(seed + 1);
  for (std::uint32_t i = 0; i < poses; ++i) {
    const std::uint32_t shape = i % shapes;
    const auto level = static_cast<std::uint8_t>(random.below(3));
    const double heading = heading_of_any_size(random);
    const auto rotation = baselines::quad_rotation(heading);
    PosedShape pose{shape, level, heading, shapes_[shape].hierarchy.reach, rotation, {}};
    for (const ExactDisc& disc : baselines::tight_discs(shapes_[shape].hierarchy, plan.depths[level]))
      pose.discs.push_back(disc.posed(rotation));
    poses_.push_back(std::move(pose));
  }
}

NearTangent near_tangent(Random& random, const TangentShapes& shapes) {
  NearTangent pair{};
  pair.a = &shapes.pose(random.below(shapes.size()));
  pair.b = &shapes.pose(random.below(shapes.size()));
  if (random.below(4) == 0) pair.at_x = random.uniform(-1e6, 1e6), pair.at_y = random.uniform(-1e6, 1e6);
  const double angle = random.uniform(-4, 4), along_x = std::cos(angle), along_y = std::sin(angle);
  pair.i = outermost(*pair.a, along_x, along_y);
  pair.j = outermost(*pair.b, -along_x, -along_y);
  const ExactDisc &a = pair.a->discs[pair.i], &b = pair.b->discs[pair.j];
  const Quad radii = a.radius + b.radius;
  const double wide = static_cast<double>(radii);
  const double distance = wide + near_gap(random, wide, pair.reaches());
  const QuadVector between = a.centre - b.centre;
  pair.x = pair.at_x + (static_cast<double>(between.x) + distance * along_x);
  pair.y = pair.at_y + (static_cast<double>(between.y) + distance * along_y);
  // The doubles that came out are the input; what is true of them:
  const Quad square_distance =
      square(QuadVector{Quad{pair.x} - pair.at_x, Quad{pair.y} - pair.at_y} - between);
  const Quad excess = square_distance - radii * radii;
  pair.meet = !(excess > 0);
  pair.gap = static_cast<double>(excess) / (2 * wide);
  return pair;
}

}  // namespace bch::test
