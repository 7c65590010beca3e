// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/geometry.hpp>

#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Represents an affine map, row by row: three of its linear part, each with what it adds. Joints are placed one after the
/// other, so that a product's latency counts: this one is a third of Eigen's.
struct AffineRows {
  alignas(16) double row[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

  AffineRows() = default;
  explicit AffineRows(const Affine3& map) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) row[i][j] = static_cast<double>(map.rows[i][j]);
  }
};

/// Returns the map that applies b first, then a.
inline AffineRows operator*(const AffineRows& a, const AffineRows& b) {
  using Simd = BaseLanes;
  AffineRows result;
  for (int i = 0; i < 3; ++i) {
    const Simd::Double x(a.row[i][0]), y(a.row[i][1]), z(a.row[i][2]);
    const auto of = [&](int k, int j) { return Simd::Double::load_aligned(&b.row[k][j]); };
    const auto half = [&](int j) { return x * of(0, j) + y * of(1, j) + z * of(2, j); };
    Simd::store(&result.row[i][0], half(0));
    Simd::store(&result.row[i][2], half(2) + Simd::of<double>(0.0, a.row[i][3]));
  }
  return result;
}

}  // namespace bch::detail
