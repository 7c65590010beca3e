// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/segment_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "layout/format/shape_set_view.hpp"

namespace bch::baselines {

SegmentClearance::SegmentClearance(std::span<const Shape> shapes, const ShapeSetPlan& plan)
    : shapes_(shapes), cuts_(shapes, plan), segments_(shapes, plan, bch::Leaves::segments) {
  for (const Shape& shape : shapes) {
    Leaves& of = leaves_.emplace_back();
    if (shape.hierarchy.primitive_ranges.empty()) continue;
    std::set<std::uint32_t> held;
    const std::vector<std::uint32_t> nodes = cut(shape.hierarchy, all_depths);
    for (std::uint32_t leaf = 0; leaf < nodes.size(); ++leaf) {
      const auto [begin, end] = shape.hierarchy.primitive_ranges[nodes[leaf]];
      if (end - begin > detail::max_leaf_segments)
        of.coarse.push_back(leaf);
      else
        held.insert(shape.hierarchy.source.begin() + begin, shape.hierarchy.source.begin() + end);
    }
    of.segments.assign(held.begin(), held.end());
  }
}

std::optional<SegmentClearance::Nearest> SegmentClearance::nearest(const Agents& agents, Pair pair) const {
  if (!segments_.decide(agents, pair)) return std::nullopt;
  const auto [first, second] = std::minmax(pair.first, pair.second);
  return least_gap(float_placement(agents, pair), agents, {first, second});
}

std::optional<float> SegmentClearance::distance(const Agents& agents, Pair pair, double max_distance) const {
  const std::optional<Nearest> found = nearest(agents, pair);
  if (!found) return std::nullopt;
  return static_cast<double>(found->distance) <= max_distance ? found->distance
                                                              : std::numeric_limits<float>::infinity();
}

SegmentClearance::Nearest SegmentClearance::least_gap(const FloatPlacement& place, const Agents& agents,
                                                      Pair in_order) const {
  const auto [first, second] = in_order;
  const std::uint32_t shape_a = agents.shape[first], shape_b = agents.shape[second];
  const Shape &a = shapes_[shape_a], &b = shapes_[shape_b];
  const Leaves &of_a = leaves_[shape_a], &of_b = leaves_[shape_b];
  const Placement in_a{static_cast<double>(place.cosine), static_cast<double>(place.sine),
                       static_cast<double>(place.x), static_cast<double>(place.y)};
  const double margin = LeafSegments::margin_of(a) + LeafSegments::margin_of(b);
  std::vector<std::array<Point2, 2>> segments_b;
  for (const std::uint32_t number : of_b.segments) {
    segments_b.push_back(LeafSegments::segment(b.outline, number));
    for (Point2& end : segments_b.back()) end = in_a.place(end.x, end.y);
  }
  Nearest least{std::numeric_limits<float>::infinity(), none, none};
  for (const std::uint32_t number : of_a.segments) {
    const std::array<Point2, 2> segment = LeafSegments::segment(a.outline, number);
    for (std::size_t j = 0; j < segments_b.size(); ++j) {
      const float gap = segment_gap(segment, segments_b[j], margin);
      if (gap < least.distance) least = {gap, number, of_b.segments[j]};
    }
  }
  // Discs decide where a leaf has too many.
  const auto discs_a = cuts_.of(agents, first), discs_b = cuts_.of(agents, second);
  const auto take_discs = [&](std::uint32_t i, std::uint32_t j) {
    const Disc &p = discs_a[i], &q = discs_b[j];
    const float x = place.x + (place.cosine * q.x - place.sine * q.y) - p.x,
                y = place.y + (place.sine * q.x + place.cosine * q.y) - p.y;
    const float gap = std::sqrt(x * x + y * y) * (1 - 0x1p-20f) - (p.radius + q.radius);
    if (std::max(gap, 0.0f) < least.distance) least = {std::max(gap, 0.0f), none, none};
  };
  for (const std::uint32_t i : of_a.coarse)
    for (std::uint32_t j = 0; j < discs_b.size(); ++j) take_discs(i, j);
  for (const std::uint32_t j : of_b.coarse)
    for (std::uint32_t i = 0; i < discs_a.size(); ++i) take_discs(i, j);
  return least;
}

}  // namespace bch::baselines
