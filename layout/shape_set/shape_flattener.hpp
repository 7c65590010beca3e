// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <vector>

#include <bch/shapes.hpp>

#include "layout/culling/interior.hpp"
#include "layout/culling/supports.hpp"
#include "layout/shape_set/bvh8.hpp"

namespace bch::detail {

/// Holds all that a set stores of a shape except its heights.
struct FlatShape {
  double max_extent = 0;
  std::vector<Bvh8> levels;  ///< one per depth
  /// The supports of the outline if the deepest level has segments, else of that level's discs. This and the next two
  /// members are used only if the plan has culling data.
  Supports supports;
  Profile profile;
  DiscBlock inscribed;
  // The following members are used only if the plan has outlines.
  Outline outline;
  std::vector<Disc> contour_disc;
  float segment_margin = 0;  ///< metres; see rounding.hpp, V
  std::vector<std::uint32_t>
      leaf_segments;  ///< of the last level, if it has exact leaves; see shape_set_view.hpp
};

/// Holds the flat form of a body.
struct FlatBody {
  ShapeSetPlan plan;
  FlatShape shape;
  Heights heights;
};

/// Makes one shape after the other flat, reusing memory. Nearly all the time of making a set is spent here. One
/// thread at a time may use an object.
class ShapeFlattener {
 public:
  /// Takes the plan of the set.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeFlattener(const ShapeSetPlan& plan);

  /// Writes a shape as flat arrays.
  /// Errors:  throws std::invalid_argument as ShapeSet does, naming the shape by `index`.
  void flatten(const Shape& shape, std::size_t index, FlatBody& flat);

  /// Copies the outline of a shape, without the segments of leaves.
  static void add_outline(const Shape& shape, FlatShape& flat);

 private:
  void flatten(const Shape& shape, FlatShape& flat);
  void require(const Shape& shape) const;
  bool has_culling() const;
  void add_levels(const Shape& shape, FlatShape& flat);
  void add_interior(const Shape& shape, FlatShape& flat);
  void add_culling(const Shape& shape, std::size_t level, FlatShape& flat);
  bool has_segments(const Shape& shape, const FlatShape& flat) const;
  void add_segments(const Shape& shape, FlatShape& flat);

  ShapeSetPlan plan_;
  Bvh8Builder bvh8_builder_;
  InteriorBuilder interiors_;
  PointDiscs points_;
  std::vector<std::uint32_t> numbered_segments_,
      leaf_segments_;  ///< numbers of segments: per point of the outline, and of one leaf
};

}  // namespace bch::detail
