// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/agents.hpp>

#include "layout/base/plain_arithmetic.hpp"

namespace bch::detail {

/// Represents a rotation by its cosine and sine.
struct Rotation {
  double cosine = 1;
  double sine = 0;
};

/// Represents a rotation by its cosine and sine in float, as queries use them.
struct UnitVector {
  float cosine = 1;
  float sine = 0;
};

/// Returns the rotation by a heading in radians, counter-clockwise, |heading| <= rounding::largest_heading. Cosine
/// and sine are each within 2e-10 of the exact value. The bits are the same on every processor, because only plain
/// operations are used; libm picks a variant by processor.
Rotation rotation(double heading) noexcept;

/// Returns the rotation by a heading given as an angle or a direction. For a direction it is the unit vector along
/// it, with the same bits on every processor; each part is within 4e-12 of the exact value if is_unit(). So bounds
/// derived for angles also hold for directions.
Rotation rotation(const Headings::Value& heading) noexcept;

/// Returns whether the length of a direction is from 0.999 to 1.001, as rotation() requires.
bool is_unit(double x, double y) noexcept;

/// Returns the rotation rounded to float: cosine and sine are each within 2^-25 (1 + 2^-7) of the exact value.
UnitVector unit_vector(double heading) noexcept;
UnitVector unit_vector(const Headings::Value& heading) noexcept;

/// Contains the constants, in the order of operations, that rotation() and the SIMD kernels share. An angle is
/// reduced to [-pi/4, pi/4] after Cody and Waite: pi/2 is split into parts of 23 bits, whose products with quadrant
/// numbers below 2^30 are exact. Then Taylor polynomials follow; the first omitted term is below 7e-12 for the sine
/// and 2e-10 for the cosine.
namespace heading_constants {

constexpr double two_over_pi = 0.63661977236758134308;
constexpr double half_pi[] = {0x1.921fb4p+0, 0x1.4442dp-24, 0x1.846988p-48, 0x1.8cc51701b839ap-72};
/// Adding this and subtracting it again rounds a number to the nearest integer.
constexpr double round_to_integer = 0x1.8p52;
constexpr double sine[] = {-1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6};
constexpr double cosine[] = {-1.0 / 3628800, 1.0 / 40320, -1.0 / 720, 1.0 / 24, -1.0 / 2};

// A direction (x, y) is multiplied twice by newton[0] - newton[1] (x^2 + y^2): steps of Newton's method for 1 / sqrt,
// in plain operations. A step takes a length of 1 + e to 1 - 3/2 e^2 - e^3 / 2: from an error of 1e-3 to 1.5e-6, and
// from that to 3.4e-12.
constexpr double newton[] = {1.5, 0.5};
constexpr double least_square = 0.998001, largest_square = 1.002001;  ///< x^2 + y^2 of a direction

}  // namespace heading_constants

}  // namespace bch::detail
