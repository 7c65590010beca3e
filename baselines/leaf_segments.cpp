// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/leaf_segments.hpp"

#include <algorithm>
#include <cmath>

#include "baselines/segment_meeting.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::baselines {

bool segments_meet(Segment p, Segment q, double margin) noexcept {
  return meeting(p, q, margin) != Meeting::none;
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
      detail::rounding::segment_margin * shape.hierarchy.max_extent +
      detail::rounding::outline_grid_steps * static_cast<double>(shape.outline.grid_step)));
}

}  // namespace bch::baselines
