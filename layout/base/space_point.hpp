// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/geometry.hpp>

namespace bch::detail {

/// Represents a point or a vector of space in double, metres.
struct SpacePoint {
  double x = 0, y = 0, z = 0;

  friend SpacePoint operator+(const SpacePoint& a, const SpacePoint& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend SpacePoint operator-(const SpacePoint& a, const SpacePoint& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend SpacePoint operator*(double s, const SpacePoint& a) { return {s * a.x, s * a.y, s * a.z}; }
};

inline SpacePoint space_point(const Vec3& a) {
  return {double{a.x}, double{a.y}, double{a.z}};
}
inline Vec3 rounded(const SpacePoint& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
inline double dot(const SpacePoint& a, const SpacePoint& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double squared_distance(const SpacePoint& a, const SpacePoint& b) {
  return dot(a - b, a - b);
}

}  // namespace bch::detail
