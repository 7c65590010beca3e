// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

/// Contains exact predicates over points of the outline's grid.
///
/// Bounds. Coordinates are at most 2^23 in magnitude, so the coordinates of a difference of points are at most 2^24,
/// and a cross or dot product of two differences is at most 2 * 2^48 = 2^49: far from the limits of int64, and exact
/// as a double. The terms of fractions are such products. Cross-multiplied fractions are below 2^98. A coordinate of
/// the point at a fraction, multiplied by the denominator (twice 2^24 * 2^49 + 2^24 * 2^49, and a carry), is below
/// 2^76: far from the limits of 128 bits.
namespace bch::detail {

__extension__ using Wide = __int128;

/// Represents a point of the grid, in grid steps.
struct GridPoint {
  std::int32_t x = 0, y = 0;
  friend bool operator==(GridPoint, GridPoint) = default;
};

struct GridVector {
  std::int64_t x, y;
};

inline GridVector operator-(GridPoint a, GridPoint b) {
  return {std::int64_t{a.x} - b.x, std::int64_t{a.y} - b.y};
}
inline std::int64_t cross(GridVector a, GridVector b) {
  return a.x * b.y - a.y * b.x;
}
inline std::int64_t dot(GridVector a, GridVector b) {
  return a.x * b.x + a.y * b.y;
}

/// Returns whether a has the lower x, or the same x and the lower y.
inline bool lexicographically_less(GridPoint a, GridPoint b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

inline bool same_direction(GridVector a, GridVector b) {
  return cross(a, b) == 0 && dot(a, b) > 0;
}

/// Represents a fraction of a segment's length: numerator / denominator in 0 to 1, denominator > 0.
struct Fraction {
  std::int64_t numerator = 0, denominator = 1;
  double value = 0;  ///< the quotient, correctly rounded

  Fraction() = default;
  Fraction(std::int64_t n, std::int64_t d)
      : Fraction(n, d, static_cast<double>(n) / static_cast<double>(d)) {}
  Fraction(std::int64_t n, std::int64_t d, double quotient) : numerator(n), denominator(d), value(quotient) {}
};

/// Returns -1, 0 or 1 for a < b, a == b, a > b. Correct rounding is monotonic: quotients that differ are in the order
/// of the fractions. Only equal quotients need exact products.
inline int compare(const Fraction& a, const Fraction& b) {
  if (a.value != b.value) return a.value < b.value ? -1 : 1;
  const Wide left = Wide{a.numerator} * b.denominator, right = Wide{b.numerator} * a.denominator;
  return (left > right) - (left < right);
}

/// Represents the point at a fraction of the segment between two grid points.
struct Place {
  GridPoint from, to;
  Fraction at;

  GridVector direction() const { return to - from; }
};

/// Returns the sign of (x of the place) - `x`, and of (y of the place) - `y`.
int compare_x(const Place& place, std::int32_t x);
int compare_y(const Place& place, std::int32_t y);

/// Returns the grid point nearest to a place; halves are rounded up. The result is the same for every pair of grid
/// points that describes the place.
GridPoint rounded(const Place& place);

}  // namespace bch::detail
