// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distance/nearest_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/simd/leaf_segments.hpp"
#include "layout/base/heading.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

PlanePoint turned(Rotation by, PlanePoint v) {
  const auto [c, s] = by;
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

Vec2 rounded(PlanePoint v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

/// Returns the parameter t of the point of a segment that is nearest to a point, given relative to its
/// beginning.
double nearest_t(PlanePoint edge, PlanePoint to_point) {
  const double square = edge.x * edge.x + edge.y * edge.y;
  return square > 0 ? std::clamp((to_point.x * edge.x + to_point.y * edge.y) / square, 0.0, 1.0) : 0;
}

}  // namespace

std::uint32_t leaf_containing(const ShapeSetView& shapes, std::size_t root, std::uint32_t point, double x,
                              double y) {
  const Tree& tree = shapes.trees[root];
  const LeafSegments<BaseLanes> leaves{shapes.leaf_segments};
  std::uint32_t found = no_node;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t number = 0; number < tree.count; ++number) {
    const auto list = leaves.segments(tree, tree.discs + number);
    bool holds = false;
    for (std::uint32_t i = 0; i < list.count; ++i) holds = holds || list.point(i) == point;
    if (!holds) continue;
    const float* const disc = shapes.nodes + tree.discs + number;
    const double dx = x - double{disc[0]}, dy = y - double{disc[tree.stride]};
    const double gap = std::sqrt(dx * dx + dy * dy) - double{disc[2 * std::size_t{tree.stride}]};
    if (gap < least) least = gap, found = number;
  }
  return found;
}

PlacedFeatures::Disc PlacedFeatures::disc(std::uint32_t agent, std::uint32_t place) const noexcept {
  const Root& alone = shapes_.roots[root(agent)];
  if (shapes_.trees == nullptr) return {double{alone.x}, double{alone.y}, double{alone.radius}};
  const std::size_t stride = shapes_.trees[root(agent)].stride;
  const float* const x = shapes_.nodes + place;
  return {double{x[0]}, double{x[stride]}, double{x[2 * stride]}};
}

PlacedFeatures::Segment PlacedFeatures::segment(std::uint32_t point) const noexcept {
  const Vec2 from = shapes_.points[point], to = shapes_.points[point + 1];
  return {
      {double{from.x}, double{from.y}}, {double{to.x} - double{from.x}, double{to.y} - double{from.y}}, 0};
}

/// The nearest points of two disjoint segments include an end of one.
PlacedFeatures::Segments PlacedFeatures::segments() const {
  const auto [first, second] = pair_;
  Segments found{segment(nearest_.a), segment(nearest_.b), {}};
  const Rotation of_a = rotation(agents_.heading[first]), of_b = rotation(agents_.heading[second]);
  const PlanePoint edge_a = turned(of_a, found.a.edge), edge_b = turned(of_b, found.b.edge);
  const PlanePoint from_a = turned(of_a, found.a.from), from_b = turned(of_b, found.b.from);
  const PlanePoint apart{agents_.x[second] - agents_.x[first] + (from_b.x - from_a.x),
                         agents_.y[second] - agents_.y[first] + (from_b.y - from_a.y)};
  const auto between = [&](double t_a, double t_b) {
    return PlanePoint{apart.x + t_b * edge_b.x - t_a * edge_a.x, apart.y + t_b * edge_b.y - t_a * edge_a.y};
  };
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](double t_a, double t_b) {
    const PlanePoint at = between(t_a, t_b);
    const double square = at.x * at.x + at.y * at.y;
    if (square >= least) return;
    least = square, found.a.t = t_a, found.b.t = t_b, found.between = at;
  };
  for (const double end : {0.0, 1.0}) {
    const PlanePoint to_b = between(0, end), to_a = between(end, 0);
    take(nearest_t(edge_a, to_b), end);
    take(end, nearest_t(edge_b, PlanePoint{-to_a.x, -to_a.y}));
  }
  return found;
}

PlanePoint PlacedFeatures::between() const {
  if (nearest_.are_segments) return segments().between;
  return turned({double{nearest_.cosine}, double{nearest_.sine}},
                PlanePoint{double{nearest_.x}, double{nearest_.y}});
}

PlanePoint PlacedFeatures::along(double sign) const {
  const auto [x, y] = between();
  if (x == 0 && y == 0) return {sign, 0};
  const double scale = sign / std::sqrt(x * x + y * y);
  return {scale * x, scale * y};
}

Vec2 PlacedFeatures::direction(double sign) const {
  return rounded(along(sign));
}

/// Returns the point of an agent's disc that is farthest along a unit vector.
Vec2 PlacedFeatures::end(std::uint32_t agent, std::uint32_t place, PlanePoint unit) const {
  const Disc of = disc(agent, place);
  const auto [x, y] = turned(rotation(agents_.heading[agent]), PlanePoint{of.x, of.y});
  return rounded(PlanePoint{x + of.radius * unit.x, y + of.radius * unit.y});
}

NearestPoints PlacedFeatures::points() const {
  const auto [first, second] = pair_;
  if (nearest_.are_segments) {
    const Segments of = segments();
    return {rounded(turned(rotation(agents_.heading[first]), of.a.nearest())),
            rounded(turned(rotation(agents_.heading[second]), of.b.nearest()))};
  }
  const PlanePoint unit = along(1);
  return {end(first, nearest_.a, unit), end(second, nearest_.b, {-unit.x, -unit.y})};
}

DiscPair PlacedFeatures::numbers() const {
  const auto [first, second] = pair_;
  if (nearest_.are_segments) {
    const Segments of = segments();
    const auto leaf = [this](std::uint32_t agent, std::uint32_t point, PlanePoint at) {
      return leaf_containing(shapes_, root(agent), point, at.x, at.y);
    };
    return {leaf(first, nearest_.a, of.a.nearest()), leaf(second, nearest_.b, of.b.nearest())};
  }
  const auto number = [&](std::uint32_t agent, std::uint32_t place) {
    return shapes_.trees == nullptr ? place : place - shapes_.trees[root(agent)].discs;
  };
  return {number(first, nearest_.a), number(second, nearest_.b)};
}

}  // namespace bch::detail
