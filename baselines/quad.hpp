// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cfloat>

namespace bch::baselines {

/// Represents IEEE binary128, which has 113 bits: sums and products of a few doubles are exact or off by 2^-112 of
/// the result. It is slow, and tells the truth about what float and double decide. It is the compiler's own
/// arithmetic, without a library.
#if LDBL_MANT_DIG == 113  // as on ARM
using Quad = long double;
#else
__extension__ using Quad = __float128;
#endif

/// Returns a square root, correct to 2^-110. Precondition: value >= 0.
Quad square_root(Quad value) noexcept;

struct QuadVector {
  Quad x = 0, y = 0;

  friend QuadVector operator+(QuadVector a, QuadVector b) noexcept { return {a.x + b.x, a.y + b.y}; }
  friend QuadVector operator-(QuadVector a, QuadVector b) noexcept { return {a.x - b.x, a.y - b.y}; }
};

inline Quad square(QuadVector v) noexcept {
  return v.x * v.x + v.y * v.y;
}

/// Returns the cosine and sine of an angle, |angle| <= 1e9 rad, each correct to 2^-105.
QuadVector quad_rotation(double angle) noexcept;

/// Returns v turned by a rotation.
inline QuadVector turned(QuadVector rotation, QuadVector v) noexcept {
  return {rotation.x * v.x - rotation.y * v.y, rotation.y * v.x + rotation.x * v.y};
}
/// Returns v turned back by a rotation.
inline QuadVector turned_back(QuadVector rotation, QuadVector v) noexcept {
  return {rotation.x * v.x + rotation.y * v.y, rotation.x * v.y - rotation.y * v.x};
}

}  // namespace bch::baselines
