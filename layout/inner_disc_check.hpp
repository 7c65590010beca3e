// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <emmintrin.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "layout/disc.hpp"
#include "layout/rounding.hpp"
#include "layout/shape_set_view.hpp"

namespace bch {

/// The one place that says how large an inner disc may be, which is what bounds the time of a pair. Below an inner disc
/// are eight discs: a block's, or those of a window, which shows what the inner disc was made for and, where that is
/// less than eight, its neighbours. An inner disc is made about the middle of the box about the centres of the cut's
/// discs that it holds, or about another centre where that needs no larger radius. So its radius is at most half of
/// that box's diagonal and the largest of the held radii. The box is that of the window's centres or, where the disc
/// holds a block, at most that about the block's discs. The centre is no farther from the box than the radius. It is not
/// asked here to hold what is below, because a smaller disc takes no time: verify() asks for that.
///
/// Rounding, in the terms of rounding.hpp: a radius is enlarged by 64 u P and by 8 u of itself, and the lengths here are
/// off by 10 u of the radius.
inline float largest_inner_slack(float reach) {
  return static_cast<float>(96 * rounding::unit_roundoff) * reach;
}

/// Boxes and largest radii of what is below the discs of a block, lane by lane.
struct HeldByLanes {
  alignas(16) float low_x[block_width], low_y[block_width], high_x[block_width], high_y[block_width];
  alignas(16) float radius[block_width];

  /// A window of discs, of which none is padding. The box is about their centres.
  void set_window(std::uint32_t lane, const float* x, std::size_t stride) {
    const float *y = x + stride, *r = y + stride;
    const __m128 x0 = _mm_loadu_ps(x), x1 = _mm_loadu_ps(x + 4), y0 = _mm_loadu_ps(y),
                 y1 = _mm_loadu_ps(y + 4);
    const __m128 low_x4 = _mm_min_ps(x0, x1), high_x4 = _mm_max_ps(x0, x1), low_y4 = _mm_min_ps(y0, y1),
                 high_y4 = _mm_max_ps(y0, y1), r4 = _mm_max_ps(_mm_loadu_ps(r), _mm_loadu_ps(r + 4));
    // Four lanes become two of x and two of y, then one of each.
    const __m128 low2 = _mm_min_ps(_mm_unpacklo_ps(low_x4, low_y4), _mm_unpackhi_ps(low_x4, low_y4));
    const __m128 high2 = _mm_max_ps(_mm_unpacklo_ps(high_x4, high_y4), _mm_unpackhi_ps(high_x4, high_y4));
    const __m128 low = _mm_min_ps(low2, _mm_movehl_ps(low2, low2));
    const __m128 high = _mm_max_ps(high2, _mm_movehl_ps(high2, high2));
    const __m128 r2 = _mm_max_ps(r4, _mm_movehl_ps(r4, r4));
    _mm_store_ss(low_x + lane, low), _mm_store_ss(low_y + lane, _mm_shuffle_ps(low, low, 1));
    _mm_store_ss(high_x + lane, high), _mm_store_ss(high_y + lane, _mm_shuffle_ps(high, high, 1));
    _mm_store_ss(radius + lane, _mm_max_ss(r2, _mm_shuffle_ps(r2, r2, 1)));
  }

  /// Eight discs, of which the last may be padding. The box is about them, or about their centres.
  void set_discs(std::uint32_t lane, const float* x, std::size_t stride, bool about_discs) {
    low_x[lane] = high_x[lane] = x[0], low_y[lane] = high_y[lane] = x[stride], radius[lane] = 0;
    for (std::uint32_t i = 0; i < block_width && x[i] < std::numeric_limits<float>::infinity(); ++i) {
      const float y = x[stride + i], r = x[2 * stride + i], around = about_discs ? r : 0;
      low_x[lane] = std::min(low_x[lane], x[i] - around),
      high_x[lane] = std::max(high_x[lane], x[i] + around);
      low_y[lane] = std::min(low_y[lane], y - around), high_y[lane] = std::max(high_y[lane], y + around);
      radius[lane] = std::max(radius[lane], r);
    }
  }

  /// Bits of the discs, x, y and radius eight each, that are larger than that or elsewhere; of padding, anything.
  std::uint32_t excess(const float* x, float slack) const {
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < block_width; k += 4) {
      const auto load = [k](const float* values) { return _mm_load_ps(values + k); };
      const __m128 at_x = _mm_loadu_ps(x + k), at_y = _mm_loadu_ps(x + block_width + k),
                   r = _mm_loadu_ps(x + 2 * block_width + k);
      const __m128 wide = _mm_sub_ps(load(high_x), load(low_x)), high = _mm_sub_ps(load(high_y), load(low_y));
      const __m128 rest =
          _mm_sub_ps(_mm_mul_ps(r, _mm_set1_ps(1 - 0x1p-18f)), _mm_add_ps(_mm_set1_ps(slack), load(radius)));
      const __m128 half = _mm_max_ps(rest, _mm_setzero_ps()), diagonal = _mm_add_ps(half, half);
      const __m128 square = _mm_add_ps(_mm_mul_ps(wide, wide), _mm_mul_ps(high, high));
      const __m128 beside = _mm_max_ps(_mm_sub_ps(at_x, load(high_x)), _mm_sub_ps(load(low_x), at_x));
      const __m128 above = _mm_max_ps(_mm_sub_ps(at_y, load(high_y)), _mm_sub_ps(load(low_y), at_y));
      const __m128 limit = _mm_add_ps(r, _mm_set1_ps(slack));
      const __m128 bad = _mm_or_ps(_mm_cmplt_ps(square, _mm_mul_ps(diagonal, diagonal)),
                                   _mm_cmplt_ps(limit, _mm_max_ps(beside, above)));
      bits |= static_cast<std::uint32_t>(_mm_movemask_ps(bad)) << k;
    }
    return bits;
  }
};

/// Whether all discs of a block, with the names of what is below them, are where that is and no larger than it needs.
/// `stride`: of the level's cut.
inline bool all_are_needed(const float* block, const float* nodes, std::uint32_t stride, float slack) {
  HeldByLanes held{};
  std::uint32_t count = 0;
  for (; count < block_width && block[count] < std::numeric_limits<float>::infinity(); ++count) {
    const auto name = std::bit_cast<std::uint32_t>(block[3 * block_width + count]);
    const float* x = nodes + (name & ~leaf_window);
    if (name < leaf_window)
      held.set_discs(count, x, block_width, true);
    else if (stride > block_width)
      held.set_window(count, x, stride);
    else
      held.set_discs(count, x, stride, false);
  }
  return (held.excess(block, slack) & ((std::uint32_t{1} << count) - 1)) == 0;
}

}  // namespace bch
