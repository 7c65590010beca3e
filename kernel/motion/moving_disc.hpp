// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <limits>

namespace bch::detail {

/// Represents a disc, or a sphere, that moves along a straight line and grows linearly during times 0 to 1:
/// its values at time 0, and their changes until time 1. z is 0 for all discs.
struct MovingDisc {
  double x, y, radius;
  double move_x, move_y, growth;
  double z = 0, move_z = 0;
};

constexpr double never = std::numeric_limits<double>::infinity();

/// Returns the first time in [0, last] at which the distance of two discs is at most `margin`, or never:
///
///     f(s) = (distance of the centres)^2 - (sum of the radii + margin)^2 = a s^2 + 2 b s + c
///     s = c / (-b + sqrt(b^2 - a c))     first root for c > 0, for either sign of a; 0 for c <= 0
inline double first_overlap(const MovingDisc& one, const MovingDisc& other, double margin,
                            double last) noexcept {
  const double x = one.x - other.x, y = one.y - other.y, r = one.radius + other.radius + margin;
  const double move_x = one.move_x - other.move_x, move_y = one.move_y - other.move_y,
               growth = one.growth + other.growth;
  const double z = one.z - other.z, move_z = one.move_z - other.move_z;
  const double c = x * x + y * y + z * z - r * r;
  const double a = move_x * move_x + move_y * move_y + move_z * move_z - growth * growth;
  const double b = x * move_x + y * move_y + z * move_z - r * growth;
  const double square = b * b - a * c;
  const double divisor = std::sqrt(square > 0 ? square : 0) - b;
  // Selections without branches, so that loops over discs are vectorised.
  double time = c / divisor;
  time = c <= last * divisor ? time : never;
  time = square < 0 ? never : time;
  time = (a < b ? a : b) < 0 ? time : never;
  return c <= 0 ? 0 : time;
}

}  // namespace bch::detail
