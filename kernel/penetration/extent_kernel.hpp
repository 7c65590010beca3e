// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/format/cut_discs.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Measures the interval that discs take along axes: low = min(c . e - r), high = max(c . e + r), with c . e = x ex + y ey. Every
/// disc is one lane of one register or of two: smallest and largest do not mind.
template <class Simd>
class ExtentKernel {
 public:
  static void run(const CutDiscs& discs, const float* axis_x, const float* axis_y, std::uint32_t axes,
                  float* low, float* high) noexcept {
    std::uint32_t i = 0;
    if (discs.count >= Simd::width)
      for (; i + at_once <= axes; i += at_once)
        group<at_once>(discs, axis_x + i, axis_y + i, low + i, high + i);
    for (; i < axes; ++i)
      if (discs.count >= Simd::width)
        group<1>(discs, axis_x + i, axis_y + i, low + i, high + i);
      else
        one_by_one(discs, axis_x[i], axis_y[i], low[i], high[i]);
  }

 private:
  using Float = typename Simd::Float;
  static constexpr std::uint32_t at_once = 4;  ///< axes, whose registers do not spill with AVX2

  template <std::uint32_t axes>
  static void group(const CutDiscs& discs, const float* axis_x, const float* axis_y, float* low,
                    float* high) noexcept {
    Float least[axes], most[axes], ex[axes], ey[axes];
    for (std::uint32_t k = 0; k < axes; ++k) {
      least[k] = Float(__builtin_inff()), most[k] = Float(-__builtin_inff());
      ex[k] = Float(axis_x[k]), ey[k] = Float(axis_y[k]);
    }
    const std::uint32_t last = discs.count - Simd::width;
    for (std::uint32_t at = 0, next = 0; next < discs.count; next += Simd::width) {
      at = next < last ? next : last;
      const Float x = Simd::load(discs.x + at), y = Simd::load(discs.y + at),
                  r = Simd::load(discs.radius + at);
#pragma GCC unroll 4
      for (std::uint32_t k = 0; k < axes; ++k) {
        const Float centre = x * ex[k] + y * ey[k];
        least[k] = xsimd::min(least[k], centre - r);
        most[k] = xsimd::max(most[k], centre + r);
      }
    }
    for (std::uint32_t k = 0; k < axes; ++k) low[k] = Simd::least(least[k]), high[k] = -Simd::least(-most[k]);
  }

  static void one_by_one(const CutDiscs& discs, float ex, float ey, float& low, float& high) noexcept {
    low = __builtin_inff(), high = -__builtin_inff();
    for (std::uint32_t i = 0; i < discs.count; ++i) {
      const float centre = discs.x[i] * ex + discs.y[i] * ey, r = discs.radius[i];
      low = centre - r < low ? centre - r : low;
      high = centre + r > high ? centre + r : high;
    }
  }
};

}  // namespace bch::detail
