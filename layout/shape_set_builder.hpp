// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/shape_storage.hpp"

namespace bch {

/// Puts flat shapes one behind the other: the same set as from all shapes at once, byte for byte.
class ShapeSetBuilder {
 public:
  /// Errors:  throws std::invalid_argument on a bad plan.
  explicit ShapeSetBuilder(const ShapeSetPlan& plan);

  /// A shape made flat with the same plan.
  /// Errors:  throws std::length_error beyond 2^31 numbers in nodes or 2^32 roots. What was added before is then as it was.
  void add(const FlatShape& flat);
  ShapeSet finish() &&;

 private:
  ShapeSetPlan plan_;
  ShapeStorage storage_;
  std::size_t shapes_ = 0;
  ShapeExtent end_{.rows = first_row};
};

}  // namespace bch
