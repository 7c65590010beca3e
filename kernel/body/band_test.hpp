// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/body/placed_bodies.hpp"
#include "kernel/simd/relative_transforms.hpp"
#include "kernel/simd/support_directions.hpp"

namespace bch::detail {

/// Holds what reaches another body: along each axis x * direction_x + y * direction_y - radius is at most so much, and heights meet low .. high.
struct Reach {
  static constexpr unsigned axes = 3;
  float x[axes], y[axes], most[axes];
  float low, high;

  [[gnu::always_inline]] void widen(float margin) noexcept {
    for (float& each : most) each += margin;
    low -= margin, high += margin;
  }
};

/// Tests bands of one body against those of the other, by their supports; lane = direction. Sets of pairs of bands have bit body_bands
/// * i + j for band i of A and j of B.
template <class Simd>
class BandTest {
 public:
  static constexpr std::uint32_t max_pairs = body_bands * body_bands;

  explicit BandTest(const RelativeTransforms<Simd>& transforms) noexcept
      : directions_(transforms), transforms_(transforms) {}

  /// Finds the directions of all pairs of the packet.
  void place() noexcept { directions_.place(); }

  /// Returns the pairs of bands that may meet and that no line separates.
  std::uint32_t open(std::uint32_t pair, const PlacedBodies& bodies) const noexcept {
    const std::uint32_t candidates = may_meet(bodies.b_in_a.tz, bodies.margin());
    if (candidates == equal_bands) [[likely]] {
      std::uint32_t open = 0;
#pragma GCC unroll 3
      for (std::uint32_t band = 0; band < body_bands; ++band)
        open |= meet(pair, bodies, band, band) << (body_bands + 1) * band;
      return open;
    }
    std::uint32_t open = 0;
    for (std::uint32_t left = candidates; left != 0; left &= left - 1) {
      const auto i = static_cast<std::uint32_t>(__builtin_ctz(left));
      open |= meet(pair, bodies, i / body_bands, i % body_bands) << i;
    }
    return open;
  }

  /// Finds, for the bands of an open pair of them, what of either body reaches the other one, along the axis on which they overlap
  /// least and those 45 degrees from it.
  void find_reach(std::uint32_t pair, const PlacedBodies& bodies, std::uint32_t bands, Reach& of_a,
                  Reach& of_b) const noexcept {
    find_axes(pair, bodies, supports(bodies.a, bands / body_bands), supports(bodies.b, bands % body_bands),
              of_a, of_b);
    of_a.widen(bodies.margin()), of_b.widen(bodies.margin());
    set_heights(of_a, bands / body_bands), set_heights(of_b, bands % body_bands);
  }

  /// Does the same for whole bodies, without a margin. Returns how far they are apart at least.
  float find_reach_of_all(std::uint32_t pair, const PlacedBodies& bodies, Reach& of_a,
                          Reach& of_b) const noexcept {
    alignas(64) float a[support_stride], b[support_stride];
    find_all_supports(bodies.a, a), find_all_supports(bodies.b, b);
    const float across = find_axes(pair, bodies, a, b, of_a, of_b);
    const BodyHeader &header_a = header_of(bodies.a), &header_b = header_of(bodies.b);
    const float dz = bodies.b_in_a.tz;
    of_a.low = header_b.bottom + dz, of_a.high = header_b.top + dz;
    of_b.low = header_a.bottom - dz, of_b.high = header_a.top - dz;
    const float below = of_a.low - header_a.top, above = header_a.bottom - of_a.high;
    const float up = below < above ? above : below;
    return across < up ? up : across;
  }

 private:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;
  static constexpr std::uint32_t equal_bands = 1 | 1 << (body_bands + 1) | 1 << 2 * (body_bands + 1);
  static_assert(body_bands == 3);
  static constexpr unsigned half = support_directions / 2;
  static constexpr unsigned quarter_turn = half / 8;  ///< 45 degrees, in directions of one half
  static constexpr float infinite = __builtin_inff();
  static constexpr float low[] = {-infinite, band_planes[0], band_planes[1]};
  static constexpr float high[] = {band_planes[0], band_planes[1], infinite};

  /// Finds the axes of Reach and what reaches along them, without a margin. Returns how far bodies are apart along the first one.
  float find_axes(std::uint32_t pair, const PlacedBodies& bodies, const float* a, const float* b, Reach& of_a,
                  Reach& of_b) const noexcept {
    // Half of the directions are enough: axes are 22.5 degrees apart.
    alignas(64) float from_b[half], overlap[half];
    Float least(__builtin_inff());
    directions_.search_along(pair, 0, directions_.rows(pair, 0, a, b),
                             [&](unsigned k, Float distance, Float by_a, Float by_b) {
                               const Float begin = distance - by_b, both = by_a - begin;
                               Simd::store(from_b + k, begin);
                               Simd::store(overlap + k, both);
                               least = xsimd::min(least, both);
                             });
    const unsigned middle = first_at_most(overlap, Simd::least(least));
    const auto [c, s, tx, ty] = bodies.b_in_a.ground;
    for (unsigned i = 0; i < Reach::axes; ++i) {
      const unsigned k = (middle + (i + half - 1) * quarter_turn) % half;
      const float x = SupportDirections<Simd>::direction_x[0][k],
                  y = SupportDirections<Simd>::direction_y[0][k];
      of_a.x[i] = -x, of_a.y[i] = -y, of_a.most[i] = -from_b[k];
      of_b.x[i] = c * x + s * y, of_b.y[i] = c * y - s * x;
      of_b.most[i] = a[k] - (tx * x + ty * y);
    }
    return -overlap[middle];
  }

  /// Finds the largest of the bands' supports.
  static void find_all_supports(const float* record, float (&to)[support_stride]) noexcept {
    for (unsigned k = 0; k < support_stride; k += Simd::width) {
      Float most = Simd::load(supports(record, 0) + k);
      for (std::uint32_t band = 1; band < body_bands; ++band)
        most = xsimd::max(most, Simd::load(supports(record, band) + k));
      Simd::store(to + k, most);
    }
  }

  static const float* supports(const float* record, std::uint32_t band) noexcept {
    return record + record_supports + band * support_stride;
  }

  static void set_heights(Reach& reach, std::uint32_t band) noexcept {
    reach.low = low[band] - band_overlap, reach.high = high[band] + band_overlap;
  }

  /// Returns the pairs of bands in which spheres may overlap. (Rounding matters only to bodies that reach a plane, and then it is within
  /// their margin.)
  static std::uint32_t may_meet(float dz, float margin) noexcept {
    if (__builtin_fabsf(dz) + margin <= band_overlap) [[likely]]
      return equal_bands;
    std::uint32_t pairs = 0;
    for (std::uint32_t i = 0; i < body_bands; ++i)
      for (std::uint32_t j = 0; j < body_bands; ++j)
        pairs |= std::uint32_t{low[i] <= high[j] + dz + margin && low[j] + dz <= high[i] + margin}
                 << (body_bands * i + j);
    return pairs;
  }

  std::uint32_t meet(std::uint32_t pair, const PlacedBodies& bodies, std::uint32_t band_a,
                     std::uint32_t band_b) const noexcept {
    const float* const a = supports(bodies.a, band_a);
    const float* const b = supports(bodies.b, band_b);
    const Float gap(bodies.wide_gap());
    Mask separated = Float(1.0f) < Float(0.0f);
    for (unsigned odd = 0; odd < 2; ++odd)
      directions_.search_along(pair, odd, directions_.rows(pair, odd, a, b),
                               [&](unsigned, Float distance, Float by_a, Float by_b) {
                                 separated = separated | (by_a + by_b + gap < distance);
                               });
    return Simd::bits(separated) == 0;
  }

  static unsigned first_at_most(const float (&values)[half], float most) noexcept {
    std::uint32_t bits = 0;
    for (unsigned k = 0; k < half; k += Simd::width)
      bits |= Simd::bits(Simd::load(values + k) <= Float(most)) << k;
    return bits == 0 ? 0 : static_cast<unsigned>(__builtin_ctz(bits));
  }

  SupportDirections<Simd> directions_;
  const RelativeTransforms<Simd>& transforms_;
};

}  // namespace bch::detail
