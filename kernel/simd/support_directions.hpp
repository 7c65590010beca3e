// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/simd/relative_transforms.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Finds, for the pairs of a packet, which supports of B (layout/culling/supports.hpp) are opposite to those of A, lane =
/// direction.
///
/// A's direction k is compared with B's direction k * D + psi, where D = 2 pi / 32 and psi = pi - (heading of B relative to
/// A). psi = (offset + fraction) * D with 0 <= fraction <= 1. B's support there is at most lower * (support of the direction
/// below) + upper * (support of the direction above): that of the corner of the two supporting lines.
template <class Simd>
class SupportDirections {
 private:
  /// Cosines of D, 2 D, ...
  static constexpr float c1 = 0.98078528f, c2 = 0.92387953f, c3 = 0.83146961f, c4 = 0.70710678f,
                         c5 = 0.55557023f, c6 = 0.38268343f, c7 = 0.19509032f;

 public:
  using Float = typename Simd::Float;

  explicit SupportDirections(const RelativeTransforms<Simd>& transforms) noexcept : transforms_(transforms) {}

  /// Computes offset, lower and upper for all pairs of the packet, lane = pair.
  void place() noexcept {
    static_assert(support_directions == 32);
    constexpr float tangent[] = {0.19891237f, 0.41421356f, 0.66817864f, 1.0f,
                                 1.4966058f,  2.4142136f,  5.0273395f};
    constexpr float cosine_of[] = {c1, c2, c3, c4, c5, c6, c7};
    constexpr float cotangent = 5.0273395f, one_over_sine = 5.1258309f;  // of D
    alignas(64) float offset[packet_size];
    const Float zero(0.0f);
    const std::uint32_t count = transforms_.whole_registers();
    for (std::uint32_t k = 0; k < count; k += Simd::width) {
      const Float x = zero - Simd::load(transforms_.c + k), y = Simd::load(transforms_.s + k);
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

  /// Points to the supports of A along its even or odd directions, and of B along the directions next to the opposite ones.
  struct Rows {
    const float *a, *below, *above;
  };
  [[gnu::always_inline]] Rows rows(std::uint32_t pair, unsigned odd, const float* a,
                                   const float* b) const noexcept {
    const unsigned offset = static_cast<unsigned>(offset_[pair]) + odd;
    return {a + odd * half, b + offset % 2 * half + offset / 2,
            b + (offset + 1) % 2 * half + (offset + 1) / 2};
  }

  /// Calls visit(k, distance, of_a, of_b) for every register of A's directions from k on: how far B's origin is along them,
  /// and how far each shape extends towards the other.
  template <class Visit>
  [[gnu::always_inline]] void search_along(std::uint32_t pair, unsigned odd, const Rows& of,
                                           Visit visit) const noexcept {
    const Float lower(lower_[pair]), upper(upper_[pair]);
    for (unsigned k = 0; k < support_directions / 2; k += Simd::width)
      visit(k, along(transforms_.tx[pair], transforms_.ty[pair], odd, k), Simd::load(of.a + k),
            lower * Simd::load(of.below + k) + upper * Simd::load(of.above + k));
  }

  /// Returns the components of a vector of A's frame along A's directions from k on.
  static Float along(float x, float y, unsigned odd, unsigned k) noexcept {
    return Float(x) * Simd::load(direction_x[odd] + k) + Float(y) * Simd::load(direction_y[odd] + k);
  }

  /// The unit vectors of the even directions, then of the odd ones.
  alignas(64) static constexpr float direction_x[2][support_directions / 2] = {
      {1, c2, c4, c6, 0, -c6, -c4, -c2, -1, -c2, -c4, -c6, 0, c6, c4, c2},
      {c1, c3, c5, c7, -c7, -c5, -c3, -c1, -c1, -c3, -c5, -c7, c7, c5, c3, c1}};
  alignas(64) static constexpr float direction_y[2][support_directions / 2] = {
      {0, c6, c4, c2, 1, c2, c4, c6, 0, -c6, -c4, -c2, -1, -c2, -c4, -c6},
      {c7, c5, c3, c1, c1, c3, c5, c7, -c7, -c5, -c3, -c1, -c1, -c3, -c5, -c7}};

 private:
  using Mask = typename Simd::Mask;
  static constexpr unsigned half = support_stride / 2;

  const RelativeTransforms<Simd>& transforms_;
  alignas(64) std::int32_t offset_[packet_size];
  alignas(64) float lower_[packet_size], upper_[packet_size];
};

}  // namespace bch::detail
