// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/heights_meet.hpp"
#include "layout/format/parts.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Finds which parts of two shapes may meet: at equal heights those of the same slab, else those of any two slabs; and their
/// heights have to meet. Each pair of parts comes once, with the lowest slabs that have it. (`Simd` keeps instruction sets from
/// sharing a function.)
template <class Simd>
class SlabPairs {
 public:
  struct Parts {
    std::uint32_t a, b;  ///< no_part: there are no more
    std::uint32_t slab_a, slab_b;
  };

  /// Takes two shapes. `rise` is the height of B's ground above A's, metres.
  SlabPairs(const ShapeSetView& shapes, std::uint32_t shape_a, std::uint32_t shape_b, double rise) noexcept
      : shapes_(shapes), shape_a_(shape_a), shape_b_(shape_b), rise_(rise) {}

  /// Returns the next pair, and moves a cursor that begins at 0. Slabs that decide most come first.
  Parts next(std::uint32_t& cursor) const noexcept {
    const std::uint32_t slabs = shapes_.slab_count, end = rise_ == 0 ? slabs : slabs * slabs;
    while (cursor < end) {
      const std::uint32_t at = cursor++;
      const Parts parts =
          rise_ == 0 ? parts_of(slab(at), slab(at)) : parts_of(slab(at / slabs), slab(at % slabs));
      if (parts.a != no_part && parts.b != no_part && heights_meet(parts) && !is_lower_down(parts))
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

  /// Returns whether lower slabs have the same parts: a body that is not cut has one in slabs that follow each other.
  bool is_lower_down(const Parts& parts) const noexcept {
    const bool a = parts.slab_a > 0 && part_of(shapes_, shape_a_, parts.slab_a - 1) == parts.a,
               b = parts.slab_b > 0 && part_of(shapes_, shape_b_, parts.slab_b - 1) == parts.b;
    return rise_ == 0 ? a && b : a || b;
  }

  /// Returns whether the heights of two parts meet, touching included.
  bool heights_meet(const Parts& parts) const noexcept {
    if (shapes_.heights == nullptr) return true;
    const Heights& a = shapes_.heights[parts.a];
    return detail::heights_meet(double{a.bottom}, double{a.top}, shapes_.heights[parts.b], rise_);
  }

  const ShapeSetView& shapes_;
  std::uint32_t shape_a_, shape_b_;
  double rise_;
};

}  // namespace bch::detail
