// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>

#include "baselines/obb_tree.hpp"
#include "baselines/placement.hpp"

/// Implements the separating-axis test of two oriented boxes: six face normals, then nine products of edges,
/// each with an early exit (Gottschalk, Lin, Manocha 1996, section 5). Rows of the relative rotation are
/// computed when an axis first needs them. Edges that are nearly parallel have a product that is nearly zero
/// and means nothing; `parallel` is added to the absolute values of the rotation, so that such an axis never
/// separates (C. Ericson, "Real-time collision detection", 2005, section 4.4.1).
///
/// Why a test in float never misses. u = 2^-24, P the extents, S = P_A + P_B, and p a point of both shapes
/// for the exact tests, so that the relative position t has |t| <= S. Let boxes be tight except for the margin.
///
///     stored axes against an orthonormal frame          u each, so a tight box grows by 2 u P
///     R_ij: b_j, turning it (3 u), a_i, their product   1 + 3 + 1 + 3 u   <= 9 u
///     centre of B, turned and moved; the difference d   10 u S
///     T_i = a_i . d, |d| <= 3 S                         10 u S + 12 u S   <= 22 u S
///
/// Face normals: |T_i| <= e_i + sum f_j |R_ij| has errors of 2 u P_A + 4 u P_B + 22 u S + 5 u (e_i + sum f_j)
/// <= 37 u S, and 9 u sum f_j. The margin m = 128 u P gives m_A + m_B sum_j |R_ij| >= 128 u S, and
/// `parallel` = 64 u gives 64 u sum f_j.
/// Edges: |T_2 R_1j - T_1 R_2j| <= e_1 |R_2j| + e_2 |R_1j| + f_k |R_0l| + f_l |R_0k|, for example. Let s be
/// the sine between the edges: s^2 = R_1j^2 + R_2j^2 = R_0k^2 + R_0l^2. A's faces did not separate, so |T_1|
/// <= e_1 + f_k + f_l + P_B s, and T_2 alike. Errors of R on the left: 9 u (|T_1| + |T_2|) <= 9 u (e_1 + e_2
/// + 2 f_k + 2 f_l) + 18 u P_B s; of T: 22 u S 1.42 s; of R on the right: 9 u (e_1 + e_2 + f_k + f_l);
/// rounding: 7 u of either side. Together below 64 u (e_1 + e_2 + f_k + f_l) + 128 u S s, which `parallel`
/// and the margins give. That is why A's faces come before edges. For u^2 terms half of it is left.
namespace bch::baselines {

constexpr float parallel = 0x1p-18f;

/// Represents a box of the second shape in the first shape's frame.
struct PlacedBox {
  float axis[3][3];
  float centre[3];
  float half[3];
};

inline PlacedBox place(const Placement& placement, const ObbNode& box) noexcept {
  const float c = static_cast<float>(placement.cosine), s = static_cast<float>(placement.sine);
  PlacedBox placed;
  for (int k = 0; k < 3; ++k) {
    const float* axis = box.axis[k];
    placed.axis[k][0] = c * axis[0] - s * axis[1];
    placed.axis[k][1] = s * axis[0] + c * axis[1];
    placed.axis[k][2] = axis[2];
    placed.half[k] = box.half[k];
  }
  placed.centre[0] = static_cast<float>(placement.x) + (c * box.centre[0] - s * box.centre[1]);
  placed.centre[1] = static_cast<float>(placement.y) + (s * box.centre[0] + c * box.centre[1]);
  placed.centre[2] = static_cast<float>(placement.z) + box.centre[2];
  return placed;
}

inline float dot3(const float* a, const float* b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns false only if the boxes have no point in common.
inline bool boxes_overlap(const ObbNode& a, const PlacedBox& b) noexcept {
  const float d[3] = {b.centre[0] - a.centre[0], b.centre[1] - a.centre[1], b.centre[2] - a.centre[2]};
  const float *e = a.half, *f = b.half;
  float t[3], r[3][3], size[3][3];  // size: |r| + parallel

  for (int i = 0; i < 3; ++i) {
    t[i] = dot3(a.axis[i], d);
    for (int j = 0; j < 3; ++j) {
      r[i][j] = dot3(a.axis[i], b.axis[j]);
      size[i][j] = std::abs(r[i][j]) + parallel;
    }
    if (std::abs(t[i]) > e[i] + (f[0] * size[i][0] + f[1] * size[i][1] + f[2] * size[i][2])) return false;
  }
  for (int j = 0; j < 3; ++j)
    if (std::abs(t[0] * r[0][j] + t[1] * r[1][j] + t[2] * r[2][j]) >
        f[j] + (e[0] * size[0][j] + e[1] * size[1][j] + e[2] * size[2][j]))
      return false;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      if (std::abs(t[i2] * r[i1][j] - t[i1] * r[i2][j]) >
          e[i1] * size[i2][j] + e[i2] * size[i1][j] + f[j1] * size[i][j2] + f[j2] * size[i][j1])
        return false;
    }
  }
  return true;
}

}  // namespace bch::baselines
