// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/sphere_query.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bch::detail {
namespace {

/// The segment of an obstacle that is nearest to a point, and its distance less its slack; none of an obstacle without segments.
struct NearestSegment {
  const LocalSegment* segment = nullptr;
  double distance = std::numeric_limits<double>::infinity();
};

NearestSegment nearest_segment(std::span<const LocalSegment> segments, double x, double y) noexcept {
  NearestSegment nearest;
  for (const LocalSegment& segment : segments) {
    const double distance = std::sqrt(segment.square_distance(x, y)) - segment.slack;
    if (distance < nearest.distance) nearest = {&segment, distance};
  }
  return nearest;
}

/// Returns whether the side of a point is plain: no segment is so near that rounding decides.
bool is_clear(const NearestSegment& nearest) noexcept {
  return nearest.segment == nullptr || nearest.distance > nearest.segment->slack;
}

}  // namespace

double SphereQuery::vertical_gap(float bottom, float top, std::uint32_t obstacle) const noexcept {
  const WorldHeights* const heights = obstacles().heights;
  if (heights == nullptr) return 0;
  const double below = heights[obstacle].bottom - (ground_ + double{top}),
               above = ground_ + double{bottom} - heights[obstacle].top;
  return std::max(std::max(below, above) - 0x1p-50 * std::abs(ground_), 0.0);
}

SphereGap SphereQuery::nearest(std::uint32_t agent, double limit) {
  SphereGap nearest{std::min(limit, farthest_gap)};
  if (!begin(agent)) return nearest;
  const auto visit = [&](std::span<const LocalSegment>) {
    near().any_obstacle([&](std::span<const LocalSegment> segments, std::uint32_t obstacle) {
      return improve(segments, obstacle, nearest), false;
    });
  };
  visit(near().found());
  visit_areas_beyond(*body_, [&](std::uint32_t area) { return improve({}, area, nearest), true; });
  search_outward(*body_, -std::numeric_limits<double>::infinity(), nearest, visit);
  return nearest;
}

void SphereQuery::improve(std::span<const LocalSegment> segments, std::uint32_t obstacle,
                          SphereGap& nearest) {
  const BodyHeader& header = header_of(record_);
  const bool is_area = obstacles().is_area[obstacle] != 0;
  AreaSide area(near(), body_->place, segments, obstacle);
  // Whether the area holds a centre that is as far from its segments as that.
  const auto is_contained = [&](const NearestSegment& segment, float x, float y) {
    return is_area && (segments.empty() || !is_clear(segment) || area.contains({x, y}));
  };
  // What is left out by bounds must not depend on their rounding.
  const double tolerance = 0x1p-44 * (std::abs(ground_) + double{header.max_extent} + std::abs(nearest.gap));
  const std::uint32_t stride = header.node_stride, size = header.leaf_size;
  const float* const nodes = record_ + record_nodes;
  for (std::uint32_t leaf = 0; leaf < header.leaf_count; ++leaf) {
    const float x = nodes[leaf], y = nodes[stride + leaf], radius = nodes[2 * stride + leaf];
    if (vertical_gap(nodes[3 * stride + leaf], nodes[4 * stride + leaf], obstacle) >
        std::max(nearest.gap + tolerance, 0.0))
      continue;
    const NearestSegment of_leaf = nearest_segment(segments, double{x}, double{y});
    const double beyond = of_leaf.distance - double{radius} - (nearest.gap + tolerance);
    // All of a leaf is on one side only where it is clear of the segments, whose gap may be less than 0.
    const bool is_beyond = beyond > 0 && (!is_area || beyond + nearest.gap > 0);
    if (is_beyond && !is_contained(of_leaf, x, y)) continue;
    const float* const spheres = leaf_of(record_, leaf);
    for (std::uint32_t i = 0; i < size; ++i) {
      const float sx = spheres[i], sy = spheres[size + i], sz = spheres[2 * size + i];
      const double r = spheres[3 * size + i], h = vertical_gap(sz, sz, obstacle);
      if (h - r > nearest.gap) continue;
      const NearestSegment segment = nearest_segment(segments, double{sx}, double{sy});
      const bool is_inside = is_beyond || is_contained(segment, sx, sy);
      const double d = is_inside ? 0 : std::max(segment.distance, 0.0);
      const double gap = std::sqrt(d * d + h * h) - r;
      if (gap < nearest.gap || (gap == nearest.gap && !nearest.is_found))
        nearest = {gap,      leaf * size + i,
                   obstacle, segment.segment == nullptr ? LocalSegment{} : *segment.segment,
                   true,     is_inside};
    }
  }
}

}  // namespace bch::detail
