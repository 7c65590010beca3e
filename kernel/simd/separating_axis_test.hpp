// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/simd/placements.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Tests whether a line separates two cuts, by their supports (layout/culling/supports.hpp), lane =
/// direction.
///
/// Against A's direction k stands B's direction k * D + psi, with D the angle between directions and psi =
/// pi - (B's turn in A's frame). psi = (offset + share) * D with 0 <= share <= 1, and a support between two
/// directions is at most lower * (that of the one below) + upper * (that of the one above), the height of
/// the corner of two supporting lines.
template <class Simd>
class SeparatingAxisTest {
 public:
  SeparatingAxisTest(const ShapeSetView& shapes, const Placements<Simd>& at) noexcept
      : shapes_(shapes), at_(at), rows_(shapes.support), row_a_(at.root_a), row_b_(at.root_b) {
    // This is right where rows are in order; see ShapeSetView.
    if (shapes.support != nullptr) rows_ += std::size_t{first_row} * support_stride;
  }

  /// Sets the rows of the pairs where the rows are not in order.
  void use_rows(const std::uint32_t* a, const std::uint32_t* b) noexcept {
    rows_ = shapes_.support, row_a_ = a, row_b_ = b;
  }

  /// Computes offset, lower and upper for all pairs of the chunk, lane = pair.
  void place_directions() noexcept {
    static_assert(support_directions == 32);
    constexpr float tangent[] = {0.19891237f, 0.41421356f, 0.66817864f, 1.0f,
                                 1.4966058f,  2.4142136f,  5.0273395f};
    constexpr float cosine_of[] = {c1, c2, c3, c4, c5, c6, c7};
    constexpr float cotangent = 5.0273395f, one_over_sine = 5.1258309f;  // of D
    alignas(64) float offset[chunk_size];
    const Float zero(0.0f);
    const std::uint32_t count = at_.whole_registers();
    for (std::uint32_t k = 0; k < count; k += Simd::width) {
      const Float x = zero - Simd::load(at_.c + k), y = Simd::load(at_.s + k);
      const Float ax = xsimd::abs(x), ay = xsimd::abs(y);
      Float up(0.0f), cosine(1.0f), sine(0.0f);
#pragma GCC unroll 7
      for (int sector = 0; sector < 7; ++sector) {
        const Mask past = Float(tangent[sector]) * ax < ay;
        up = Simd::select(past, Float(static_cast<float>(sector + 1)), up);
        cosine = Simd::select(past, Float(cosine_of[sector]), cosine);
        sine = Simd::select(past, Float(cosine_of[6 - sector]), sine);
      }
      const Float rest_cosine = ax * cosine + ay * sine, rest_sine = ay * cosine - ax * sine;
      const Float near = rest_cosine - Float(cotangent) * rest_sine, far = Float(one_over_sine) * rest_sine;
      // No operator on masks: in xsimd 8.1, != is wrong with SSE2 (it compares as floats, and a full mask is
      // a NaN) and ^ with AVX-512.
      const Mask left = x < zero, below = y < zero;
      const auto by_quadrant = [&](Float first, Float second, Float third, Float fourth) {
        return Simd::select(left, Simd::select(below, third, second), Simd::select(below, fourth, first));
      };
      Simd::store(offset + k, by_quadrant(up, Float(15.0f) - up, Float(16.0f) + up, Float(31.0f) - up));
      Simd::store(lower_ + k, by_quadrant(near, far, near, far));
      Simd::store(upper_ + k, by_quadrant(far, near, far, near));
    }
    for_whole_registers<Simd>(count,
                              [&](std::uint32_t k) { offset_[k] = static_cast<std::int32_t>(offset[k]); });
  }

  /// Returns whether a line across one of A's even directions, or of its odd ones, separates the pair.
  std::uint32_t apart(std::uint32_t pair, unsigned odd) const noexcept {
    std::uint32_t separated = 0;
    Float gap(0.0f);
    if constexpr (KnowsGaps<Simd>) gap = Float(at_.bound_gap[pair]);
    look_along(pair, odd, [&](unsigned, Float distance, Float reach) {
      if constexpr (KnowsGaps<Simd>) reach = reach + gap;
      separated |= Simd::bits(reach < distance);
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

  /// Returns whether a line separates the pair all the while that A moves by (x, y), with `slack` to spare.
  std::uint32_t apart_on_the_way(std::uint32_t pair, unsigned odd, float x, float y,
                                 float slack) const noexcept {
    std::uint32_t separated = 0;
    look_along(pair, odd, [&](unsigned k, Float distance, Float reach) {
      const Float way = xsimd::max(along(x, y, odd, k), Float(0.0f));
      separated |= Simd::bits(reach < distance - way - Float(slack));
    });
    return separated != 0;
  }

 private:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;

  const float* supports(std::uint32_t row) const noexcept {
    return rows_ + std::size_t{row} * support_stride;
  }

  /// Names the supports of A along its even or odd directions, and of B on either side of the opposite ones.
  struct Rows {
    const float *a, *below, *above;
  };
  [[gnu::always_inline]] Rows rows(std::uint32_t pair, unsigned odd) const noexcept {
    const unsigned offset = static_cast<unsigned>(offset_[pair]) + odd;
    const float* const b = supports(row_b_[pair]);
    return {supports(row_a_[pair]) + odd * half, b + offset % 2 * half + offset / 2,
            b + (offset + 1) % 2 * half + (offset + 1) / 2};
  }

  /// Calls visit(k, distance, reach) for every register: along A's directions from k on, how far B is and how
  /// far the two extend together.
  template <class Visit>
  [[gnu::always_inline]] void look_along(std::uint32_t pair, unsigned odd, Visit visit) const noexcept {
    const auto [a, below, above] = rows(pair, odd);
    const Float lower(lower_[pair]), upper(upper_[pair]);
    for (unsigned k = 0; k < support_directions / 2; k += Simd::width)
      visit(k, along(at_.tx[pair], at_.ty[pair], odd, k),
            Simd::load(a + k) + (lower * Simd::load(below + k) + upper * Simd::load(above + k)));
  }

  static Float along(float x, float y, unsigned odd, unsigned k) noexcept {
    return Float(x) * Simd::load(direction_x[odd] + k) + Float(y) * Simd::load(direction_y[odd] + k);
  }

  static constexpr unsigned half = support_stride / 2;
  /// Cosines of D, 2 D, ...
  static constexpr float c1 = 0.98078528f, c2 = 0.92387953f, c3 = 0.83146961f, c4 = 0.70710678f,
                         c5 = 0.55557023f, c6 = 0.38268343f, c7 = 0.19509032f;
  /// The unit vectors of the even directions, then of the odd ones.
  alignas(64) static constexpr float direction_x[2][support_directions / 2] = {
      {1, c2, c4, c6, 0, -c6, -c4, -c2, -1, -c2, -c4, -c6, 0, c6, c4, c2},
      {c1, c3, c5, c7, -c7, -c5, -c3, -c1, -c1, -c3, -c5, -c7, c7, c5, c3, c1}};
  alignas(64) static constexpr float direction_y[2][support_directions / 2] = {
      {0, c6, c4, c2, 1, c2, c4, c6, 0, -c6, -c4, -c2, -1, -c2, -c4, -c6},
      {c7, c5, c3, c1, c1, c3, c5, c7, -c7, -c5, -c3, -c1, -c1, -c3, -c5, -c7}};

  const ShapeSetView& shapes_;
  const Placements<Simd>& at_;
  const float* rows_;
  const std::uint32_t *row_a_, *row_b_;  ///< per pair
  alignas(64) std::int32_t offset_[chunk_size];
  alignas(64) float lower_[chunk_size], upper_[chunk_size];
};

}  // namespace bch::detail
