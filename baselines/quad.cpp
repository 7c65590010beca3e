// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/quad.hpp"

#include <cmath>

namespace bch::baselines {
namespace {

constexpr double two_over_pi = 0.63661977236758134308;
/// pi / 2 in parts of 53 bits, whose products with a quadrant number below 2^30 are exact. What follows is below 2^-162.
constexpr double half_pi[] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54, -0x1.f1976b7ed8fbcp-110};

/// Taylor's series from the term x^first / first! on, |x| <= 0.8: the last term is below 2^-115.
Quad series(Quad x, int first) {
  const Quad minus_square = -x * x;
  Quad term = first == 0 ? Quad{1} : x, sum = term;
  for (int n = first + 1; n <= first + 29; n += 2) {
    term = term * minus_square / Quad{static_cast<double>(n * (n + 1))};
    sum += term;
  }
  return sum;
}

}  // namespace

Quad square_root(Quad value) noexcept {
  if (!(value > 0)) return 0;
  Quad root = std::sqrt(static_cast<long double>(value));
  // Newton's steps double the 64 bits that are right.
  for (int i = 0; i < 2; ++i) root = (root + value / root) / Quad{2};
  return root;
}

QuadVector quad_rotation(double angle) noexcept {
  const double quarters = std::nearbyint(angle * two_over_pi);
  Quad r = angle;
  for (const double part : half_pi) r -= Quad{quarters} * Quad{part};
  const Quad c = series(r, 0), s = series(r, 1);
  switch (static_cast<long long>(quarters) & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace bch::baselines
