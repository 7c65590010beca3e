// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <vector>

#include "layout/culling/interior.hpp"
#include "layout/culling/supports.hpp"
#include "layout/shape_set/shape_set.hpp"
#include "layout/shape_set/wide_tree.hpp"

namespace bch {

/// All that a set stores of a shape, before it has a place there.
struct FlatShape {
  ShapeSetPlan plan;
  double reach = 0;
  std::vector<WideTree> levels;  ///< one a depth
  Supports supports;  ///< of the deepest level; this and the next two only with the plan's shortcuts
  Profile profile;
  Interior interior;
  // Only with the plan's outlines.
  Outline outline;
  std::vector<Disc> contour_disc;
  float segment_margin = 0;  ///< metres; see rounding.hpp, V
  std::vector<std::uint32_t>
      leaf_segments;  ///< of the last level, if that has exact leaves; see shape_set_view.hpp
};

/// Makes shape after shape flat, with memory that is reused; where nearly all the time goes that a set takes.
/// For one thread.
class ShapeFlattener {
 public:
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeFlattener(const ShapeSetPlan& plan);

  /// Errors:  throws std::invalid_argument as ShapeSet does, naming the shape by `index`.
  void flatten(const Shape& shape, std::size_t index, FlatShape& flat);

 private:
  void require(const Shape& shape, std::size_t index) const;
  bool has_shortcuts() const;
  void add_levels(const Shape& shape, FlatShape& flat);
  void add_interior(const Shape& shape, FlatShape& flat);
  void add_shortcuts(std::size_t level, FlatShape& flat) const;
  static void add_outline(const Shape& shape, FlatShape& flat);
  void add_segments(const Hierarchy& hierarchy, FlatShape& flat);

  ShapeSetPlan plan_;
  Flattener flattener_;
  InteriorBuilder interiors_;
  std::vector<std::uint32_t> moved_,
      held_;  ///< numbers of segments: of all by the outline's points, and of one leaf
};

}  // namespace bch
