// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <emmintrin.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <xsimd/xsimd.hpp>

#include "layout/disc.hpp"
#include "layout/shape_set_view.hpp"

namespace bch {

/// Discs side by side; whole registers may be read from `count` - 1 on.
struct DiscRun {
  const float *x, *y, *radius;
  std::uint32_t count;
};

struct Extent {
  Vec2 low, high;
};

/// Loops over a cut's discs.
template <class Arch>
class CutLanes {
 public:
  /// Of the discs' centres.
  static Extent extent(const DiscRun& run) noexcept {
    Batch low_x(infinity), low_y(infinity), high_x(-infinity), high_y(-infinity);
    for_each(run, [&](const Batch& x, const Batch& y, const Batch&, const Batch& there) {
      low_x = xsimd::min(x + there, low_x);
      low_y = xsimd::min(y + there, low_y);
      high_x = xsimd::max(x + there, high_x);
      high_y = xsimd::max(y + there, high_y);
    });
    return {{-largest(-low_x), -largest(-low_y)}, {largest(high_x), largest(high_y)}};
  }

  /// Radii of the discs about two centres that hold a run, to 5 units in the last place.
  static void radii(const DiscRun& run, const Vec2 (&about)[2], float (&radius)[2]) noexcept {
    const Batch a_x(about[0].x), a_y(about[0].y), b_x(about[1].x), b_y(about[1].y);
    Batch a(0.0f), b(0.0f);
    for_each(run, [&](const Batch& x, const Batch& y, const Batch& r, const Batch& there) {
      const auto reach = [&](const Batch& dx, const Batch& dy) {
        return xsimd::sqrt(dx * dx + dy * dy) + (r + there);
      };
      a = xsimd::max(reach(x - a_x, y - a_y), a);
      b = xsimd::max(reach(x - b_x, y - b_y), b);
    });
    radius[0] = largest(a);
    radius[1] = largest(b);
  }

  /// The run's extents along support_directions directions, to 6 units in the last place of its reach. Those of the
  /// first quadrant are given; the others are these turned by a quarter, a half and three quarters, so that they
  /// share products.
  static void heights(const DiscRun& run, const float* cosine, const float* sine, float* height) noexcept {
    for (std::size_t k = 0; k < quadrant; k += Batch::size) {
      const Batch c = Batch::load_unaligned(cosine + k), s = Batch::load_unaligned(sine + k);
      Batch h[4] = {Batch(-infinity), Batch(-infinity), Batch(-infinity), Batch(-infinity)};
      for (std::uint32_t i = 0; i < run.count; ++i) {
        const Batch x(run.x[i]), y(run.y[i]), r(run.radius[i]);
        const Batch along = c * x + s * y, across = c * y - s * x;
        h[0] = xsimd::max(h[0], r + along);
        h[1] = xsimd::max(h[1], r + across);
        h[2] = xsimd::max(h[2], r - along);
        h[3] = xsimd::max(h[3], r - across);
      }
      for (std::size_t turn = 0; turn < 4; ++turn) h[turn].store_unaligned(height + turn * quadrant + k);
    }
  }

 private:
  using Batch = xsimd::batch<float, Arch>;
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  static constexpr std::size_t quadrant = support_directions / 4;

  /// Also hands out 0 in the lanes of the run's discs and NaN in others, which a minimum or maximum drops when it comes
  /// first: that is one instruction, where selecting is three.
  template <class Visit>
  static void for_each(const DiscRun& run, Visit visit) {
    alignas(64) float lane[Batch::size];
    for (std::size_t i = 0; i < Batch::size; ++i) lane[i] = static_cast<float>(i);
    const Batch index = Batch::load_aligned(lane), gone(std::numeric_limits<float>::quiet_NaN());
    for (std::uint32_t i = 0; i < run.count; i += Batch::size) {
      const auto is_there = index < Batch(static_cast<float>(run.count - i));
      visit(Batch::load_unaligned(run.x + i), Batch::load_unaligned(run.y + i),
            Batch::load_unaligned(run.radius + i), xsimd::select(is_there, Batch(0.0f), gone));
    }
  }

  static float largest(const Batch& values) {
    static_assert(Batch::size == 4);
    const __m128 two = _mm_max_ps(values, _mm_movehl_ps(values, values));
    return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 1)));
  }
};

}  // namespace bch
