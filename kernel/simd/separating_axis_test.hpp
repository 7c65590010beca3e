// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/simd/relative_transforms.hpp"
#include "kernel/simd/support_directions.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Tests whether a line separates two cuts, by their supports (layout/culling/supports.hpp), lane = direction.
template <class Simd>
class SeparatingAxisTest {
 public:
  SeparatingAxisTest(const ShapeSetView& shapes, const RelativeTransforms<Simd>& transforms) noexcept
      : shapes_(shapes),
        transforms_(transforms),
        rows_(shapes.support),
        row_a_(transforms.root_a),
        row_b_(transforms.root_b),
        directions_(transforms) {
    // Holds if rows follow roots (see ShapeSetView); else use_rows() is called.
    if (shapes.support != nullptr) rows_ += std::size_t{first_row} * support_stride;
  }

  /// Sets the rows of the pairs' supports, if rows do not follow roots.
  void use_rows(const std::uint32_t* a, const std::uint32_t* b) noexcept {
    rows_ = shapes_.support, row_a_ = a, row_b_ = b;
  }

  /// Finds B's directions for all pairs of the packet.
  void place_directions() noexcept { directions_.place(); }

  /// Returns whether a line perpendicular to one of A's even directions, or of its odd ones, separates the pair. `excess` is
  /// that of ProfileTest.
  std::uint32_t apart(std::uint32_t pair, unsigned odd, float excess) const noexcept {
    std::uint32_t separated = 0;
    if constexpr (KnowsGaps<Simd>) excess += transforms_.bound_gap[pair];
    directions_.search_along(pair, odd, rows(pair, odd),
                             [&](unsigned, Float distance, Float of_a, Float of_b) {
                               separated |= Simd::bits(of_a + of_b + Float(excess) < distance);
                             });
    return separated != 0;
  }

  /// Prefetches what apart() will read.
  [[gnu::always_inline]] void prefetch(std::uint32_t pair, unsigned odd) const noexcept {
    const auto [a, below, above] = rows(pair, odd);
    __builtin_prefetch(a);
    // Both ends of B's rows: they begin anywhere in a cache line.
    constexpr unsigned last = support_directions / 2 - 1;
    __builtin_prefetch(below), __builtin_prefetch(below + last);
    __builtin_prefetch(above), __builtin_prefetch(above + last);
  }

  /// Returns whether one line separates the pair during all of A's displacement (x, y), with `slack` to spare.
  std::uint32_t apart_on_the_way(std::uint32_t pair, unsigned odd, float x, float y,
                                 float slack) const noexcept {
    std::uint32_t separated = 0;
    directions_.search_along(pair, odd, rows(pair, odd),
                             [&](unsigned k, Float distance, Float of_a, Float of_b) {
                               const Float way = xsimd::max(Directions::along(x, y, odd, k), Float(0.0f));
                               separated |= Simd::bits(of_a + of_b < distance - way - Float(slack));
                             });
    return separated != 0;
  }

 private:
  using Float = typename Simd::Float;
  using Directions = SupportDirections<Simd>;

  const float* supports(std::uint32_t row) const noexcept {
    return rows_ + std::size_t{row} * support_stride;
  }

  [[gnu::always_inline]] typename Directions::Rows rows(std::uint32_t pair, unsigned odd) const noexcept {
    return directions_.rows(pair, odd, supports(row_a_[pair]), supports(row_b_[pair]));
  }

  const ShapeSetView& shapes_;
  const RelativeTransforms<Simd>& transforms_;
  const float* rows_;
  const std::uint32_t *row_a_, *row_b_;  ///< per pair
  Directions directions_;
};

}  // namespace bch::detail
