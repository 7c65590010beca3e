// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/base/plain_arithmetic.hpp"

namespace bch::detail {

/// Holds cosine and sine of a heading.
struct Rotation {
  double cosine = 1;
  double sine = 0;
};

/// Represents a rotation's cosine and sine in float, as queries use them.
struct UnitVector {
  float cosine = 1;
  float sine = 0;
};

/// Returns the rotation by a heading in radians, counter-clockwise, |heading| <= rounding::largest_heading; each part is
/// within 2e-10 of the exact one. The bits are the same on every processor: only plain operations are used,
/// where libm picks a variant by processor.
Rotation rotation(double heading) noexcept;

/// Returns the rotation rounded to float: each part is within 2^-25 (1 + 2^-7) of the exact one.
UnitVector unit_vector(double heading) noexcept;

/// Holds the constants and the order of operations that rotation() and the SIMD kernels share. Reduction to
/// [-pi/4, pi/4] after Cody and Waite: pi/2 in parts of 23 bits, whose products with a quadrant number below
/// 2^30 are exact. Then Taylor's polynomials; the first term left out is below 7e-12 for the sine and 2e-10
/// for the cosine.
namespace heading_constants {

constexpr double two_over_pi = 0.63661977236758134308;
constexpr double half_pi[] = {0x1.921fb4p+0, 0x1.4442dp-24, 0x1.846988p-48, 0x1.8cc51701b839ap-72};
/// A number that rounds to the nearest integer what it is added to and then subtracted from.
constexpr double round_to_integer = 0x1.8p52;
constexpr double sine[] = {-1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6};
constexpr double cosine[] = {-1.0 / 3628800, 1.0 / 40320, -1.0 / 720, 1.0 / 24, -1.0 / 2};

}  // namespace heading_constants

}  // namespace bch::detail
