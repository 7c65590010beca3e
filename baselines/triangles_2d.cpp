// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include "baselines/exact_tests.hpp"

namespace bch::baselines {
namespace {

/// Bounding intervals are apart, on either axis.
bool apart(const Triangle2& s, const Triangle2& t) {
  const auto low = [](double a, double b, double c) { return std::min(std::min(a, b), c); };
  const auto high = [](double a, double b, double c) { return std::max(std::max(a, b), c); };
  return high(s[0].x, s[1].x, s[2].x) < low(t[0].x, t[1].x, t[2].x) ||
         high(t[0].x, t[1].x, t[2].x) < low(s[0].x, s[1].x, s[2].x) ||
         high(s[0].y, s[1].y, s[2].y) < low(t[0].y, t[1].y, t[2].y) ||
         high(t[0].y, t[1].y, t[2].y) < low(s[0].y, s[1].y, s[2].y);
}

/// An edge of s, which turns by `turn` != 0, has all of t strictly outside.
bool edge_separates(const Triangle2& s, int turn, const Triangle2& t) {
  for (int i = 0; i < 3; ++i) {
    const Point2 &a = s[static_cast<std::size_t>(i)], &b = s[static_cast<std::size_t>((i + 1) % 3)];
    if (orientation(a, b, t[0]) == -turn && orientation(a, b, t[1]) == -turn &&
        orientation(a, b, t[2]) == -turn)
      return true;
  }
  return false;
}

bool edges_meet(const Triangle2& s, const Triangle2& t) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (segments_meet({s[i], s[(i + 1) % 3]}, {t[j], t[(j + 1) % 3]})) return true;
  return false;
}

/// Returns whether a triangle that turns by `turn` != 0 contains a point.
bool contains(const Triangle2& s, int turn, const Point2& p) {
  return orientation(s[0], s[1], p) != -turn && orientation(s[1], s[2], p) != -turn &&
         orientation(s[2], s[0], p) != -turn;
}

}  // namespace

bool segments_meet(const Segment2& s, const Segment2& t) noexcept {
  // Boxes first: they settle most pairs, and collinear segments, which pass every test below.
  if (std::max(s.a.x, s.b.x) < std::min(t.a.x, t.b.x) || std::max(t.a.x, t.b.x) < std::min(s.a.x, s.b.x) ||
      std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) || std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y))
    return false;
  return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) <= 0 &&
         orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) <= 0;
}

bool triangles_meet(const Triangle2& s, const Triangle2& t) noexcept {
  if (apart(s, t)) return false;
  const int turn_s = orientation(s[0], s[1], s[2]), turn_t = orientation(t[0], t[1], t[2]);
  // Two convex polygons that are apart are separated by the line of an edge of one of them.
  if (turn_s != 0 && turn_t != 0) return !edge_separates(s, turn_s, t) && !edge_separates(t, turn_t, s);
  // A triangle without area is the union of its edges.
  return edges_meet(s, t) || (turn_s != 0 && contains(s, turn_s, t[0])) ||
         (turn_t != 0 && contains(t, turn_t, s[0]));
}

}  // namespace bch::baselines
