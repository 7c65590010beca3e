// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/format/parts.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Finds which parts of two shapes may meet: at equal heights those of the same slab, else those of any two slabs; and their
/// heights have to meet. Each pair of parts comes once, or twice where slabs that do not follow each other share it. (`Simd`
/// keeps instruction sets from sharing a function.)
template <class Simd>
class SlabPairs {
 public:
  struct Parts {
    std::uint32_t a, b;  ///< no_part: there are no more
    std::uint32_t slab_a, slab_b;
  };

  /// `rise`: metres from the ground of A to that of B.
  SlabPairs(const ShapeSetView& shapes, std::uint32_t shape_a, std::uint32_t shape_b, double rise) noexcept
      : shapes_(shapes), shape_a_(shape_a), shape_b_(shape_b), rise_(rise) {}

  /// Returns the next pair, and moves a cursor that begins at 0. Slabs that decide most come first.
  Parts next(std::uint32_t& cursor) const noexcept {
    const std::uint32_t slabs = shapes_.slab_count, end = rise_ == 0 ? slabs : slabs * slabs;
    while (cursor < end) {
      const std::uint32_t at = cursor++;
      const std::uint32_t i = rise_ == 0 ? at : at / slabs, j = rise_ == 0 ? at : at % slabs;
      const Parts parts = parts_of(slab(i), slab(j));
      if (parts.a == no_part || parts.b == no_part || !heights_meet(parts)) continue;
      if (at > 0 && is_repeated(i, j, parts)) continue;
      return parts;
    }
    return {no_part, no_part, 0, 0};
  }

 private:
  std::uint32_t slab(std::uint32_t i) const noexcept {
    return shapes_.slab_order == nullptr ? i : shapes_.slab_order[i];
  }
  Parts parts_of(std::uint32_t slab_a, std::uint32_t slab_b) const noexcept {
    return {part_of(shapes_, shape_a_, slab_a), part_of(shapes_, shape_b_, slab_b), slab_a, slab_b};
  }

  /// Returns whether the step before had the same parts: those of a body that is the same at all of its heights.
  bool is_repeated(std::uint32_t i, std::uint32_t j, const Parts& parts) const noexcept {
    if (rise_ == 0) {
      const Parts before = parts_of(slab(i - 1), slab(j - 1));
      return before.a == parts.a && before.b == parts.b;
    }
    return (j > 0 && part_of(shapes_, shape_b_, slab(j - 1)) == parts.b) ||
           (i > 0 && part_of(shapes_, shape_a_, slab(i - 1)) == parts.a);
  }

  /// Heights that touch meet. The slack is for the rounding of the sums: heights are within 1e6 m or infinite.
  bool heights_meet(const Parts& parts) const noexcept {
    if (shapes_.heights == nullptr) return true;
    const Heights a = shapes_.heights[parts.a], b = shapes_.heights[parts.b];
    const double slack = 1e-9 + 0x1p-50 * __builtin_fabs(rise_);
    return double{a.bottom} <= double{b.top} + rise_ + slack &&
           double{b.bottom} + rise_ <= double{a.top} + slack;
  }

  const ShapeSetView& shapes_;
  std::uint32_t shape_a_, shape_b_;
  double rise_;
};

}  // namespace bch::detail
