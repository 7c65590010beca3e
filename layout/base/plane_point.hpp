// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Represents a point or a vector of the ground plane in double, metres.
struct PlanePoint {
  double x = 0, y = 0;

  friend PlanePoint operator+(const PlanePoint& a, const PlanePoint& b) { return {a.x + b.x, a.y + b.y}; }
  friend PlanePoint operator-(const PlanePoint& a, const PlanePoint& b) { return {a.x - b.x, a.y - b.y}; }
  friend PlanePoint operator*(double factor, const PlanePoint& p) { return {factor * p.x, factor * p.y}; }
};

inline PlanePoint plane_point(const Vec2& p) {
  return {double{p.x}, double{p.y}};
}
inline double dot(const PlanePoint& a, const PlanePoint& b) {
  return a.x * b.x + a.y * b.y;
}
inline double cross(const PlanePoint& a, const PlanePoint& b) {
  return a.x * b.y - a.y * b.x;
}
inline double squared_length(const PlanePoint& v) {
  return dot(v, v);
}
inline double length(const PlanePoint& v) {
  return std::sqrt(squared_length(v));
}
/// Returns the squared distance of a point from a segment.
inline double squared_distance(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const PlanePoint edge = b - a, to = p - a;
  const double square = squared_length(edge);
  const double t = square > 0 ? std::clamp(dot(to, edge) / square, 0.0, 1.0) : 0;
  return squared_length(to - t * edge);
}
inline PlanePoint lower(const PlanePoint& a, const PlanePoint& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y)};
}
inline PlanePoint upper(const PlanePoint& a, const PlanePoint& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y)};
}

}  // namespace bch::detail
