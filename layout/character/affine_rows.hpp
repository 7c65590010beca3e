// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <emmintrin.h>

#include <bch/geometry.hpp>

namespace bch::detail {

/// An affine map, row by row: three of its linear part, each with what it adds. Joints are placed one after the
/// other, so that a product's latency counts: this one is a third of Eigen's.
struct AffineRows {
  alignas(16) double row[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

  AffineRows() = default;
  explicit AffineRows(const Affine3& map) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) row[i][j] = static_cast<double>(map.rows[i][j]);
  }
};

/// The map that applies b first, then a.
inline AffineRows operator*(const AffineRows& a, const AffineRows& b) {
  AffineRows result;
  for (int i = 0; i < 3; ++i) {
    const __m128d x = _mm_set1_pd(a.row[i][0]), y = _mm_set1_pd(a.row[i][1]), z = _mm_set1_pd(a.row[i][2]);
    const auto half = [&](int j) {
      return _mm_add_pd(
          _mm_add_pd(_mm_mul_pd(x, _mm_load_pd(&b.row[0][j])), _mm_mul_pd(y, _mm_load_pd(&b.row[1][j]))),
          _mm_mul_pd(z, _mm_load_pd(&b.row[2][j])));
    };
    _mm_store_pd(&result.row[i][0], half(0));
    _mm_store_pd(&result.row[i][2], _mm_add_pd(half(2), _mm_set_pd(a.row[i][3], 0)));
  }
  return result;
}

}  // namespace bch::detail
