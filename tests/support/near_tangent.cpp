// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/near_tangent.hpp"

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
  if (random.below(2) == 0) {
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

/// The disc of the cut that goes furthest along (x, y).
std::uint32_t outermost(const PosedShape& pose, double x, double y) {
  const auto& discs = pose.cut.discs;
  return *std::max_element(pose.cut.cut.begin(), pose.cut.cut.end(), [&](std::uint32_t i, std::uint32_t j) {
    return extent(discs[i], x, y) < extent(discs[j], x, y);
  });
}

/// Two discs, and the unit vector from the first one's centre to the second's where they touch.
struct Touching {
  std::uint32_t i, j;
  double distance;  ///< that b has gone until then
  double x, y;
};

/// Of all discs above a disc of each cut, these included, the first that part as b goes along (x, y) from where the centres
/// of the two are one point.
Touching first_to_part(const baselines::ExactCut& a, std::span<const std::uint32_t> path_a,
                       const baselines::ExactCut& b, std::span<const std::uint32_t> path_b, double x,
                       double y) {
  const QuadVector begin = a.discs[path_a[0]].centre - b.discs[path_b[0]].centre;
  Touching first{0, 0, HUGE_VAL, x, y};
  for (const std::uint32_t i : path_a)
    for (const std::uint32_t j : path_b) {
      const QuadVector between = a.discs[i].centre - b.discs[j].centre - begin;
      const double dx = static_cast<double>(between.x), dy = static_cast<double>(between.y);
      const double radii = static_cast<double>(a.discs[i].radius + b.discs[j].radius);
      const double across = x * dy - y * dx,
                   along = std::sqrt(std::max(0.0, radii * radii - across * across));
      const double distance = x * dx + y * dy + along;
      if (distance < first.distance)
        first = {i, j, distance, (along * x + across * y) / radii, (along * y - across * x) / radii};
    }
  return first;
}

/// How far the squares of two discs' distance and of their radii are apart, exactly; `shift` leads from a's agent to b's.
Quad excess(const ExactDisc& a, const ExactDisc& b, QuadVector shift) {
  const Quad radii = a.radius + b.radius;
  return square(shift - (a.centre - b.centre)) - radii * radii;
}

double near_gap(Random& random, double radii, double reaches) {
  switch (random.below(4)) {
    case 0:
      return (static_cast<int>(random.below(129)) - 64) * 0x1p-52 * radii;
    case 1:
      return random.uniform(-8, 8) * detail::rounding::unit_roundoff * reaches;
    default:
      return (static_cast<int>(random.below(129)) - 64) * 0x1p-24 * radii;
  }
}

void place(Random& random, NearTangent& pair, const Touching& touching) {
  const double radii = pair.radii(), distance = radii + near_gap(random, radii, pair.reaches());
  const QuadVector between = pair.disc_a().centre - pair.disc_b().centre;
  pair.x = pair.at_x + (static_cast<double>(between.x) + distance * touching.x);
  pair.y = pair.at_y + (static_cast<double>(between.y) + distance * touching.y);
}

bool all_overlap(const NearTangent& pair, std::span<const std::uint32_t> path_a,
                 std::span<const std::uint32_t> path_b, QuadVector shift) {
  for (const std::uint32_t i : path_a)
    for (const std::uint32_t j : path_b)
      if (excess(pair.a->cut.discs[i], pair.b->cut.discs[j], shift) > 0) return false;
  return true;
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
    const Hierarchy& hierarchy = shapes_[shape].hierarchy;
    poses_.push_back({shape, level, heading, hierarchy.reach, rotation,
                      baselines::exact_cut(hierarchy, plan.depths[level]).posed(rotation)});
  }
}

NearTangent near_tangent(Random& random, const TangentShapes& shapes) {
  NearTangent pair{};
  pair.a = &shapes.pose(random.below(shapes.size()));
  pair.b = &shapes.pose(random.below(shapes.size()));
  if (random.below(4) == 0) pair.at_x = random.uniform(-1e6, 1e6), pair.at_y = random.uniform(-1e6, 1e6);
  const double angle = random.uniform(-4, 4), along_x = std::cos(angle), along_y = std::sin(angle);
  const auto path_a = pair.a->cut.path(outermost(*pair.a, along_x, along_y)),
             path_b = pair.b->cut.path(outermost(*pair.b, -along_x, -along_y));
  const Touching touching = first_to_part(pair.a->cut, path_a, pair.b->cut, path_b, along_x, along_y);
  pair.i = touching.i, pair.j = touching.j;
  pair.above = pair.i != path_a[0] || pair.j != path_b[0];
  place(random, pair, touching);
  // The doubles that came out are the input; what is true of them:
  const QuadVector shift{Quad{pair.x} - pair.at_x, Quad{pair.y} - pair.at_y};
  pair.meet = all_overlap(pair, path_a, path_b, shift);
  pair.gap = static_cast<double>(excess(pair.disc_a(), pair.disc_b(), shift)) / (2 * pair.radii());
  return pair;
}

}  // namespace bch::test
