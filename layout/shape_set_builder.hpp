// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include "layout/aligned_vector.hpp"
#include "layout/interior.hpp"
#include "layout/shape_set.hpp"
#include "layout/supports.hpp"
#include "layout/wide_tree.hpp"

namespace bch {

/// All that a set stores of a shape, before it has a place there.
struct FlatShape {
  double reach = 0;
  std::vector<WideTree> levels;    ///< one a depth
  std::vector<Supports> supports;  ///< likewise; this and the next two only with the plan's shortcuts
  Interior interior;
  Enclosure enclosure;
  Outline outline;  ///< this and the next only with a solid plan
  std::vector<Disc> contour_disc;
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
  void add_interior(const Shape& shape, FlatShape& flat);
  static void add_outline(const Outline& outline, FlatShape& flat);

  ShapeSetPlan plan_;
  Flattener flattener_;
  InteriorBuilder interiors_;
};

/// Puts flat shapes one behind the other: the same set as from all shapes at once, byte for byte.
class ShapeSetBuilder {
 public:
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeSetBuilder(const ShapeSetPlan& plan);

  /// A shape made flat with the same plan.
  /// Errors:  throws std::length_error beyond 2^31 numbers in nodes or 2^32 roots.
  void add(const FlatShape& flat);
  ShapeSet finish() &&;

 private:
  void add_level(const WideTree& tree);
  void add_interior(const FlatShape& flat);
  void add_outline(const FlatShape& flat);
  ShapeArrays arrays() const;

  ShapeSetPlan plan_;
  AlignedVector<std::uint32_t> depths_;
  AlignedVector<Root> roots_;
  AlignedVector<Tree> trees_;
  AlignedVector<float> nodes_;
  AlignedVector<float> reach_;
  AlignedVector<float> support_;
  AlignedVector<DiscBlock> inscribed_;
  AlignedVector<Extremes> extremes_;
  AlignedVector<Enclosure> enclosures_;
  AlignedVector<std::uint32_t> shape_contours_, contour_points_;
  AlignedVector<Disc> contour_disc_;
  AlignedVector<Vec2> points_;
};

}  // namespace bch
