// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <emmintrin.h>

#include <bch/hierarchy.hpp>

namespace bch::detail {

/// Radii of published discs from the squares of the smallest, two at a time: enlarged by a margin and rounded up.
class OutwardRadii {
 public:
  /// Takes the margin that is added to radii, in metres.
  explicit OutwardRadii(double margin) : margin_(_mm_set1_pd(margin)) {}

  void write(__m128d squares, HierarchyNode& first, HierarchyNode& second) const {
    const __m128d exact = _mm_add_pd(_mm_mul_pd(_mm_sqrt_pd(squares), _mm_set1_pd(1 + 0x1p-50)), margin_);
    const __m128 nearest = _mm_cvtpd_ps(exact);
    // Rounds up as rounding::round_up() does: a comparison that holds is -1.
    const __m128 below = _mm_castpd_ps(_mm_cmplt_pd(_mm_cvtps_pd(nearest), exact));
    const __m128i step = _mm_castps_si128(_mm_shuffle_ps(below, below, _MM_SHUFFLE(2, 0, 2, 0)));
    const __m128 radius = _mm_castsi128_ps(_mm_sub_epi32(_mm_castps_si128(nearest), step));
    _mm_store_ss(&first.disc.radius, radius);
    _mm_store_ss(&second.disc.radius, _mm_shuffle_ps(radius, radius, 1));
  }

 private:
  __m128d margin_;
};

}  // namespace bch::detail
