// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/aligned_vector.hpp"
#include "layout/hierarchy.hpp"
#include "layout/outline.hpp"
#include "layout/shape_set_view.hpp"

namespace bch {

class InteriorBuilder;
struct WideTree;

/// One pose of a character.
struct Shape {
  Outline outline;
  Hierarchy hierarchy;
};

/// What a scene will use of its shapes; nothing else is built or stored.
struct ShapeSetPlan {
  /// The levels of detail: cut depths, ascending. Level k of every shape is its cut at depths[k].
  std::vector<std::uint32_t> depths = {all_depths};
  /// Keep what the solid semantics needs (the outlines, to see one shape inside another).
  bool solid = false;
  /// Keep what lets a query skip most traversals: supports and, of shapes with an outline, inscribed discs.
  /// They change no answer; a set that answers few queries does without.
  bool shortcuts = true;
};

/// The flat form of many shapes for batch queries: structure of arrays, aligned to cache lines, immutable.
class ShapeSet {
 public:
  /// Errors:  throws std::invalid_argument on a plan without depths or with depths out of order, on a shape
  ///          without nodes (naming it), and with a solid plan on an outline that validate() rejects;
  ///          std::length_error beyond 2^31 numbers in nodes.
  explicit ShapeSet(std::span<const Shape> shapes, const ShapeSetPlan& plan = {});

  ShapeSet(ShapeSet&&) noexcept = default;
  ShapeSet& operator=(ShapeSet&&) noexcept = default;

  ShapeSetView view() const noexcept;
  std::uint32_t shape_count() const noexcept { return static_cast<std::uint32_t>(reach_.size()); }
  std::uint32_t level_count() const noexcept { return static_cast<std::uint32_t>(depths_.size()); }
  std::span<const std::uint32_t> depths() const noexcept { return depths_; }
  bool solid() const noexcept { return !shape_contours_.empty(); }
  /// Every cut is a single disc: there are roots and nothing else.
  bool roots_only() const noexcept { return trees_.empty(); }
  std::size_t bytes() const noexcept;

 private:
  void add_level(const WideTree& tree);
  void add_interior(const Outline& outline, double reach, InteriorBuilder& builder);
  void add_outline(const Outline& outline);

  std::vector<std::uint32_t> depths_;
  AlignedVector<Root> roots_;
  AlignedVector<Tree> trees_;
  AlignedVector<float> nodes_;
  AlignedVector<float> reach_;
  bool has_single_discs_ = false;
  AlignedVector<float> support_;
  AlignedVector<DiscBlock> inscribed_;
  AlignedVector<Extremes> extremes_;
  AlignedVector<Enclosure> enclosures_;
  AlignedVector<std::uint32_t> shape_contours_, contour_points_;
  AlignedVector<Disc> contour_disc_;
  AlignedVector<Vec2> points_;
};

}  // namespace bch
