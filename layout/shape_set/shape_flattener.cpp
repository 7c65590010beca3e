// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/shape_flattener.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/culling/profile.hpp"
#include "layout/enclosing_disc/enclosing_disc.hpp"
#include "layout/format/leaf_segments.hpp"

namespace bch::detail {
namespace {

/// Checks the primitives of a hierarchy over the segments of an outline, as far as exact leaves use them.
void require_segments(const Shape& shape) {
  const Outline& outline = shape.outline;
  const Hierarchy& hierarchy = shape.hierarchy;
  if (!hierarchy.of_segments || outline.contours() == 0) return;
  if (hierarchy.primitive_ranges.size() != hierarchy.nodes.size())
    throw std::invalid_argument("hierarchy: " + std::to_string(hierarchy.primitive_ranges.size()) +
                                " ranges of primitives for " + std::to_string(hierarchy.nodes.size()) +
                                " nodes");
  for (std::size_t i = 0; i < hierarchy.primitive_ranges.size(); ++i)
    if (const auto [begin, end] = hierarchy.primitive_ranges[i];
        begin >= end || end > hierarchy.source.size())
      throw std::invalid_argument("hierarchy: node " + std::to_string(i) + " holds primitives " +
                                  std::to_string(begin) + " to " + std::to_string(end) + " of " +
                                  std::to_string(hierarchy.source.size()));
  for (std::size_t i = 0; i < hierarchy.source.size(); ++i)
    if (hierarchy.source[i] >= outline.points.size())
      throw std::invalid_argument("hierarchy: primitive " + std::to_string(i) + " comes from segment " +
                                  std::to_string(hierarchy.source[i]) + " of " +
                                  std::to_string(outline.points.size()));
}

}  // namespace

ShapeFlattener::ShapeFlattener(const ShapeSetPlan& plan) : plan_(plan) {
  validate(plan);
}

void ShapeFlattener::flatten(const Shape& shape, std::size_t index, FlatBody& flat) {
  flat.plan = plan_;
  try {
    if (!(shape.heights.bottom <= shape.heights.top))
      throw std::invalid_argument("heights: from " + shortest(shape.heights.bottom) + " to " +
                                  shortest(shape.heights.top) + " m");
    flat.heights = shape.heights;
    require(shape);
    flatten(shape, flat.shape);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("shape set: shape " + std::to_string(index) + ": " + error.what());
  }
}

void ShapeFlattener::flatten(const Shape& shape, FlatShape& flat) {
  flat.max_extent = shape.hierarchy.max_extent;
  add_levels(shape, flat);
  if (!plan_.outlines) return;
  add_outline(shape, flat);
  add_segments(shape, flat);
}

void ShapeFlattener::require(const Shape& shape) const {
  validate(shape.hierarchy);
  if (plan_.outlines) require_segments(shape);
  if (plan_.outlines && shape.outline.contours() > 0) validate(shape.outline);
}

bool ShapeFlattener::has_culling() const {
  return plan_.culling && plan_.depths.back() > 0;
}

void ShapeFlattener::add_levels(const Shape& shape, FlatShape& flat) {
  if (has_culling()) add_interior(shape, flat);
  flat.levels.resize(plan_.depths.size());
  bvh8_builder_.begin(shape.hierarchy);
  for (std::size_t k = 0; k < plan_.depths.size(); ++k) {
    bvh8_builder_.flatten(plan_.depths[k], flat.levels[k]);
    if (has_culling()) add_culling(shape, k, flat);
  }
}

/// Areas are those of outlines. Where none is kept there are no inscribed discs: padding, which overlaps nothing.
void ShapeFlattener::add_interior(const Shape& shape, FlatShape& flat) {
  Interior inside{};
  inside.x.fill(std::numeric_limits<float>::infinity());
  static const Outline none;
  const Outline& outline = plan_.outlines ? shape.outline : none;
  if (outline.contours() > 0) inside = interiors_.build(outline, shape.hierarchy.max_extent);
  std::copy(inside.x.begin(), inside.x.end(), flat.inscribed.x);
  std::copy(inside.y.begin(), inside.y.end(), flat.inscribed.y);
  std::copy(inside.radius.begin(), inside.radius.end(), flat.inscribed.radius);
  flat.profile = profile(outline, inside, shape.hierarchy.max_extent);
  for (Sector& sector : flat.profile.sectors) sector.shallow_outer = 0;
}

/// Adds the culling data of the level that was made flat last. Single discs need none above the deepest
/// level.
void ShapeFlattener::add_culling(const Shape& shape, std::size_t level, FlatShape& flat) {
  const bool deepest = level + 1 == plan_.depths.size();
  if (flat.levels[level].is_single() && !deepest) return;
  auto& sectors = flat.profile.sectors;
  const Outer outer_of_discs = bvh8_builder_.outer(flat.profile);
  if (!deepest) {
    for (std::uint32_t k = 0; k < profile_sectors; ++k)
      sectors[k].shallow_outer = std::max(sectors[k].shallow_outer, outer_of_discs[k]);
    return;
  }
  const Bounds discs{bvh8_builder_.supports(), outer_of_discs};
  const bool by_segments = has_segments(shape, flat);
  if (by_segments) points_.assign(shape.outline);
  const Bounds bounds =
      by_segments ? outline_bounds(flat.profile, points_, shape.hierarchy.max_extent) : discs;
  flat.supports = bounds.supports;
  for (std::uint32_t k = 0; k < profile_sectors; ++k) sectors[k].outer = bounds.outer[k];
  flat.profile.excess = excess(discs, bounds);
  flat.profile.discs_decide = by_segments ? 0.0f : 1.0f;
}

/// Returns whether the deepest level has exact leaves.
bool ShapeFlattener::has_segments(const Shape& shape, const FlatShape& flat) const {
  return plan_.outlines && plan_.depths.back() == all_depths && !flat.levels.back().is_single() &&
         shape.hierarchy.of_segments && shape.outline.contours() > 0;
}

void ShapeFlattener::add_outline(const Shape& shape, FlatShape& flat) {
  const Outline& outline = flat.outline = shape.outline;
  flat.segment_margin =
      rounding::round_up(rounding::segment_margin * shape.hierarchy.max_extent +
                         rounding::outline_grid_steps * static_cast<double>(outline.grid_step));
  flat.contour_disc.clear();
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const EnclosingDisc disc = smallest_enclosing_disc(outline.contour(c));
    flat.contour_disc.push_back({disc.centre.x, disc.centre.y, rounding::round_up(disc.radius)});
  }
}

void ShapeFlattener::add_segments(const Shape& shape, FlatShape& flat) {
  flat.leaf_segments.clear();
  if (!has_segments(shape, flat)) return;
  const Hierarchy& hierarchy = shape.hierarchy;
  const Outline& outline = flat.outline;
  // Each contour's first point follows its last one, which moves the points of the contours after it.
  numbered_segments_.resize(outline.points.size());
  for (std::uint32_t c = 0; c < outline.contours(); ++c)
    for (std::uint32_t i = outline.contour_begin[c]; i < outline.contour_begin[c + 1]; ++i)
      numbered_segments_[i] = i + c;
  std::size_t leaf = 0;
  for (std::size_t i = 0; i < hierarchy.nodes.size(); ++i) {
    if (!hierarchy.nodes[i].is_leaf()) continue;
    leaf_segments_.clear();
    for (std::uint32_t k = hierarchy.primitive_ranges[i].begin; k < hierarchy.primitive_ranges[i].end; ++k)
      leaf_segments_.push_back(numbered_segments_[hierarchy.source[k]]);
    add_leaf(leaf_segments_, leaf++, flat.levels.back().count, flat.leaf_segments);
  }
  if (has_culling() &&
      std::count(flat.leaf_segments.begin(), flat.leaf_segments.begin() + flat.levels.back().count, 0u) > 0)
    flat.profile.discs_decide = 1;
}

}  // namespace bch::detail
