// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/leaf_segments.hpp"

#include <algorithm>
#include <cmath>

#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::baselines {
namespace {

using Segment = std::array<Point2, 2>;

Point2 minus(Point2 a, Point2 b) {
  return {a.x - b.x, a.y - b.y};
}

/// The sides of a segment's line on which two points lie: one value each, and the least value of a point at a
/// distance of one margin from the line.
struct Sides {
  double first, second, margin;

  Sides(const Segment& of, const Segment& points, double distance) {
    const Point2 way = minus(of[1], of[0]);
    const auto side = [&](Point2 point) {
      const Point2 to = minus(point, of[0]);
      return way.x * to.y - way.y * to.x;
    };
    first = side(points[0]), second = side(points[1]);
    margin = distance * (std::abs(way.x) + std::abs(way.y));
  }

  bool on_one_side() const { return std::min(first, second) > margin || std::max(first, second) < -margin; }
  bool on_both_sides() const {
    const double sure = detail::rounding::sure_share * margin;
    return std::max(first, second) > sure && std::min(first, second) < -sure;
  }
};

double square_distance(Point2 point, const Segment& segment) {
  const Point2 way = minus(segment[1], segment[0]), to = minus(point, segment[0]);
  const double square = way.x * way.x + way.y * way.y;
  double share = 0;
  if (square > 0) share = std::clamp((to.x * way.x + to.y * way.y) / square, 0.0, 1.0);
  const double x = to.x - share * way.x, y = to.y - share * way.y;
  return x * x + y * y;
}

double square_of_ends(const Segment& p, const Segment& q) {
  return std::min({square_distance(p[0], q), square_distance(p[1], q), square_distance(q[0], p),
                   square_distance(q[1], p)});
}

}  // namespace

bool segments_meet(Segment p, Segment q, double margin) noexcept {
  const Sides of_p(p, q, margin), of_q(q, p, margin);
  if (of_p.on_one_side() || of_q.on_one_side()) return false;
  if (of_p.on_both_sides() && of_q.on_both_sides()) return true;
  return square_of_ends(p, q) <= margin * margin;
}

float segment_gap(Segment p, Segment q, double margin) noexcept {
  if (Sides(p, q, margin).on_both_sides() && Sides(q, p, margin).on_both_sides()) return 0;
  return static_cast<float>(std::max(std::sqrt(square_of_ends(p, q)) * (1 - 0x1p-21) - margin, 0.0));
}

Segment LeafSegments::segment(const Outline& outline, std::uint32_t number) {
  const auto& begin = outline.contour_begin;
  const auto after = std::upper_bound(begin.begin(), begin.end(), number);
  const std::uint32_t next = number + 1 == *after ? *(after - 1) : number + 1;
  return {exact(outline.points[number]), exact(outline.points[next])};
}

LeafSegments::LeafSegments(std::span<const Shape> shapes, const ShapeSetPlan& plan, Leaves leaves)
    : shapes_(shapes), level_count_(plan.depths.size()) {
  for (const Shape& shape : shapes)
    for (const std::uint32_t depth : plan.depths)
      exact_.push_back(leaves == Leaves::segments && plan.outlines && depth == all_depths &&
                       shape.hierarchy.of_segments && shape.hierarchy.nodes.size() > 1 &&
                       shape.outline.contours() > 0);
}

bool LeafSegments::decide(const Agents& agents, Pair pair) const {
  return exact_[agents.root(pair.first, level_count_)] && exact_[agents.root(pair.second, level_count_)];
}

bool LeafSegments::meet(const FloatPlacement& place, const Agents& agents, Pair pair, std::uint32_t node_a,
                        std::uint32_t node_b) const {
  const auto [first, second] = std::minmax(pair.first, pair.second);
  const Shape &a = shapes_[agents.shape[first]], &b = shapes_[agents.shape[second]];
  const Placement in_a{static_cast<double>(place.cosine), static_cast<double>(place.sine),
                       static_cast<double>(place.x), static_cast<double>(place.y)};
  const double margin = margin_of(a) + margin_of(b);
  const auto [begin_a, end_a] = a.hierarchy.primitive_ranges[node_a];
  const auto [begin_b, end_b] = b.hierarchy.primitive_ranges[node_b];
  if (std::max(end_a - begin_a, end_b - begin_b) > detail::max_leaf_segments) return true;
  for (std::uint32_t i = begin_a; i < end_a; ++i)
    for (std::uint32_t j = begin_b; j < end_b; ++j) {
      Segment of_b = segment(b.outline, b.hierarchy.source[j]);
      for (Point2& end : of_b) end = in_a.place(end.x, end.y);
      if (segments_meet(segment(a.outline, a.hierarchy.source[i]), of_b, margin)) return true;
    }
  return false;
}

std::vector<std::array<Point2, 2>> LeafSegments::segments_of(const Shape& shape, std::uint32_t node) {
  std::vector<Segment> segments;
  const auto [begin, end] = shape.hierarchy.primitive_ranges[node];
  if (end - begin > detail::max_leaf_segments) return segments;
  for (std::uint32_t i = begin; i < end; ++i)
    segments.push_back(segment(shape.outline, shape.hierarchy.source[i]));
  return segments;
}

double LeafSegments::margin_of(const Shape& shape) {
  return static_cast<double>(detail::rounding::round_up(
      detail::rounding::segment_margin * shape.hierarchy.reach +
      detail::rounding::outline_grid_steps * static_cast<double>(shape.outline.grid_step)));
}

}  // namespace bch::baselines
