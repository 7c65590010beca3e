// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/rotation_blend.hpp"

#include <cmath>

#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

using Simd = BaseLanes;
using Double = Simd::Double;

/// An arc with a cosine of at least that needs so many terms: the first one left out is below 1e-9.
constexpr double nearest_to_series = 0.9;
constexpr int terms = 7;

/// sin(t angle) / sin(angle) of two t, by what is missing of the angle's cosine to 1.
/// Source:  D. Eberly, "A fast and accurate algorithm for computing SLERP", Journal of Graphics, GPU, and Game
///          Tools 15, 2011.
Double slerp_weights(Double t, double missing) {
  const Double one(1.0), square = t * t;
  Double sum = one;
  for (int i = terms; i > 0; --i)
    sum = one + (Double(i * i) - square) * Double(missing * (1.0 / (i * (2 * i + 1)))) * sum;
  return t * sum;
}

/// A quaternion in two registers.
struct Four {
  Double half[2];

  explicit Four(const Quaternion& q) { Simd::to_double(Simd::load(&q.x), half); }
  Four(Double low, Double high) : half{low, high} {}
};

Four operator+(const Four& a, const Four& b) {
  return {a.half[0] + b.half[0], a.half[1] + b.half[1]};
}
Four operator*(double factor, const Four& q) {
  return {Double(factor) * q.half[0], Double(factor) * q.half[1]};
}
double dot(const Four& a, const Four& b) {
  return xsimd::hadd(a.half[0] * b.half[0] + a.half[1] * b.half[1]);
}

}  // namespace

Eigen::Quaterniond slerp(const Quaternion& a, const Quaternion& b, float t) {
  Four from(a), to(b);
  double along = static_cast<double>(t), cosine = dot(from, to);
  if (cosine < 0) cosine = -cosine, to = -1 * to;
  while (cosine < nearest_to_series) {  // twice at most: a right angle is halved
    const Four middle = 1 / std::sqrt(2 + 2 * cosine) * (from + to);
    const bool first_half = along < 0.5;
    (first_half ? to : from) = middle;
    along = first_half ? 2 * along : 2 * along - 1;
    cosine = std::sqrt(0.5 + 0.5 * cosine);
  }
  const Double weight = slerp_weights(Simd::of<double>(1 - along, along), 1 - cosine);
  const Four sum = Simd::lane(weight, 0) * from + Simd::lane(weight, 1) * to;
  const Four unit = 1 / std::sqrt(dot(sum, sum)) * sum;
  Eigen::Quaterniond result;
  Simd::store(result.coeffs().data(), unit.half[0]);
  Simd::store(result.coeffs().data() + 2, unit.half[1]);
  return result;
}

}  // namespace bch::detail
