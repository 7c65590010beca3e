// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include <bch/geometry.hpp>

#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds discs in parallel arrays. Whole registers can be read from any disc on, up to `count` - 1.
struct DiscRun {
  const float *x, *y, *radius;
  std::uint32_t count;
};

/// Provides loops over a cut's discs.
template <class Simd>
class CutLanes {
 public:
  /// Returns the radius about a centre that encloses a run of discs, to 5 units in the last place.
  static float radius(const DiscRun& run, Vec2 centre) noexcept {
    const Batch centre_x(centre.x), centre_y(centre.y);
    Batch most(0.0f);
    for_each(run, [&](const Batch& x, const Batch& y, const Batch& r, const Batch& there) {
      const Batch dx = x - centre_x, dy = y - centre_y;
      most = Simd::max(xsimd::sqrt(dx * dx + dy * dy) + (r + there), most);
    });
    return -Simd::least(-most);
  }

  /// Writes the extents of a run of discs along support_directions directions, to 6 units in the last place of its
  /// extent. The arguments are the directions of the first quadrant; the others are these rotated by 1 to 3 quarter
  /// turns, so that they share products.
  static void heights(const DiscRun& run, const float* cosine, const float* sine, float* height) noexcept {
    for (std::size_t k = 0; k < quadrant; k += Batch::size) {
      const Batch c = Simd::load(cosine + k), s = Simd::load(sine + k);
      Batch h[4] = {Batch(-infinity), Batch(-infinity), Batch(-infinity), Batch(-infinity)};
      for (std::uint32_t i = 0; i < run.count; ++i) {
        const Batch x(run.x[i]), y(run.y[i]), r(run.radius[i]);
        const Batch along = c * x + s * y, across = c * y - s * x;
        h[0] = xsimd::max(h[0], r + along);
        h[1] = xsimd::max(h[1], r + across);
        h[2] = xsimd::max(h[2], r - along);
        h[3] = xsimd::max(h[3], r - across);
      }
      for (std::size_t turn = 0; turn < 4; ++turn) Simd::store(height + turn * quadrant + k, h[turn]);
    }
  }

 private:
  using Batch = typename Simd::Float;
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  static constexpr std::size_t quadrant = support_directions / 4;

  /// Calls visit(x, y, radius, gap) for each register of the run. `gap` is 0 in the lanes of discs of the run and NaN
  /// in the others. A maximum drops NaN if it is the first argument: one instruction instead of the three of a
  /// selection.
  template <class Visit>
  static void for_each(const DiscRun& run, Visit visit) {
    alignas(64) float lane[Batch::size];
    for (std::size_t i = 0; i < Batch::size; ++i) lane[i] = static_cast<float>(i);
    const Batch index = Batch::load_aligned(lane), gone(std::numeric_limits<float>::quiet_NaN());
    for (std::uint32_t i = 0; i < run.count; i += Batch::size) {
      const auto is_there = index < Batch(static_cast<float>(run.count - i));
      visit(Simd::load(run.x + i), Simd::load(run.y + i), Simd::load(run.radius + i),
            xsimd::select(is_there, Batch(0.0f), gone));
    }
  }
};

}  // namespace bch::detail
