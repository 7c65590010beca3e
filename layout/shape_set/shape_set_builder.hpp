// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <span>

#include "layout/shape_set/shape_storage.hpp"

namespace bch {

/// Puts flat shapes one behind the other: the same set as from all shapes at once, byte for byte.
class ShapeSetBuilder {
 public:
  /// `expected_shapes`: how many there may be in the end, for the room that is made at once. More and fewer are right.
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeSetBuilder(const ShapeSetPlan& plan, std::size_t expected_shapes = 0);

  /// A shape made flat with the same plan.
  /// Errors:  throws std::length_error beyond 2^31 numbers in nodes or 2^32 roots. What was added before is then as it was.
  void add(const FlatShape& flat);
  /// Those of the shapes so far, as the set is going to have them, none for roots alone; until the next call of another
  /// function.
  std::span<const float> nodes() const noexcept;
  ShapeSet finish() &&;

 private:
  void reserve();

  ShapeSetPlan plan_;
  std::size_t expected_shapes_;
  ShapeStorage storage_;
  std::size_t shapes_ = 0;
  ShapeExtent end_{.rows = first_row};
};

}  // namespace bch
