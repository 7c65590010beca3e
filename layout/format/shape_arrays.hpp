// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <bch/geometry.hpp>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Holds the arrays of a shape set with their sizes, owned or not; ShapeSetView describes their content. Each array
/// begins on a cache line.
struct ShapeArrays {
  std::span<const std::uint32_t> depths;  ///< cut depths, ascending: one per level, 1 to 255 of them
  std::span<const Root> roots;
  std::span<const Tree> trees;
  std::span<const float> nodes, max_extent, support;
  std::span<const DiscBlock> inscribed;
  std::span<const Profile> profiles;
  std::span<const ContourRange> shape_contours;
  std::span<const Contour> contours;
  std::span<const Vec2> points;
  std::span<const std::uint32_t> leaf_segments;
  std::span<const float> segment_margin;
  std::span<const Heights> heights;

  std::size_t shape_count() const noexcept { return depths.empty() ? 0 : roots.size() / depths.size(); }
};

/// Calls visit(name, array...) for each array of a set, in the order of a baked file, with the same array of all
/// `sets`. These are ShapeArrays, or any type that has members of these names.
template <class Visit, class... Sets>
void for_each_array(Visit visit, Sets&... sets) {
  visit("depths", sets.depths...);
  visit("roots", sets.roots...);
  visit("trees", sets.trees...);
  visit("nodes", sets.nodes...);
  visit("max_extent", sets.max_extent...);
  visit("support", sets.support...);
  visit("inscribed", sets.inscribed...);
  visit("profiles", sets.profiles...);
  visit("shape_contours", sets.shape_contours...);
  visit("contours", sets.contours...);
  visit("points", sets.points...);
  visit("leaf_segments", sets.leaf_segments...);
  visit("segment_margin", sets.segment_margin...);
  visit("heights", sets.heights...);
}

}  // namespace bch::detail
