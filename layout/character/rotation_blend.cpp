// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/rotation_blend.hpp"

#include <emmintrin.h>

#include <cmath>

namespace bch::detail {
namespace {

/// A way with a cosine of at least that needs so many terms: the first one left out is below 1e-9.
constexpr double nearest_to_series = 0.9;
constexpr int terms = 7;

/// sin(t angle) / sin(angle) of two t, by what is missing of the angle's cosine to 1.
/// Source:  D. Eberly, "A fast and accurate algorithm for computing SLERP", Journal of Graphics, GPU, and Game
///          Tools 15, 2011.
__m128d shares(__m128d t, double missing) {
  const __m128d one = _mm_set1_pd(1), square = _mm_mul_pd(t, t);
  __m128d sum = one;
  for (int i = terms; i > 0; --i) {
    const __m128d factor =
        _mm_mul_pd(_mm_sub_pd(_mm_set1_pd(i * i), square), _mm_set1_pd(missing * (1.0 / (i * (2 * i + 1)))));
    sum = _mm_add_pd(one, _mm_mul_pd(factor, sum));
  }
  return _mm_mul_pd(t, sum);
}

/// A quaternion in two registers of every x86-64 processor.
struct Four {
  __m128d low, high;

  explicit Four(const Quaternion& q) {
    const __m128 coefficients = _mm_loadu_ps(&q.x);
    low = _mm_cvtps_pd(coefficients), high = _mm_cvtps_pd(_mm_movehl_ps(coefficients, coefficients));
  }
  Four(__m128d low_two, __m128d high_two) : low(low_two), high(high_two) {}
};

Four operator+(const Four& a, const Four& b) {
  return {_mm_add_pd(a.low, b.low), _mm_add_pd(a.high, b.high)};
}
Four operator*(double factor, const Four& q) {
  const __m128d both = _mm_set1_pd(factor);
  return {_mm_mul_pd(both, q.low), _mm_mul_pd(both, q.high)};
}
double dot(const Four& a, const Four& b) {
  const __m128d sums = _mm_add_pd(_mm_mul_pd(a.low, b.low), _mm_mul_pd(a.high, b.high));
  return _mm_cvtsd_f64(_mm_add_sd(sums, _mm_unpackhi_pd(sums, sums)));
}

}  // namespace

Eigen::Quaterniond slerp(const Quaternion& a, const Quaternion& b, float t) {
  Four from(a), to(b);
  double along = static_cast<double>(t), cosine = dot(from, to);
  if (cosine < 0) cosine = -cosine, to = -1 * to;
  while (cosine < nearest_to_series) {  // twice at most: a right angle is halved
    const Four middle = 1 / std::sqrt(2 + 2 * cosine) * (from + to);
    const bool first_half = along < 0.5;
    (first_half ? to : from) = middle;
    along = first_half ? 2 * along : 2 * along - 1;
    cosine = std::sqrt(0.5 + 0.5 * cosine);
  }
  const __m128d share = shares(_mm_setr_pd(1 - along, along), 1 - cosine);
  const Four sum = _mm_cvtsd_f64(share) * from + _mm_cvtsd_f64(_mm_unpackhi_pd(share, share)) * to;
  const Four unit = 1 / std::sqrt(dot(sum, sum)) * sum;
  Eigen::Quaterniond result;
  _mm_storeu_pd(result.coeffs().data(), unit.low);
  _mm_storeu_pd(result.coeffs().data() + 2, unit.high);
  return result;
}

}  // namespace bch::detail
