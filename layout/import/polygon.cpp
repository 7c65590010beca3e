// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/polygon.hpp"

#include <algorithm>
#include <cmath>

namespace bch::detail::importing {
namespace {

/// A corner seen along an axis. Its coordinates are floats, so the product of two is exact in double.
struct Point {
  double x = 0, y = 0;
  bool operator==(const Point&) const = default;
};

int sign(double number) {
  return (number > 0) - (number < 0);
}

/// Returns the sign of the exact sum: each term is added to an expansion, whose parts are ordered by size and overlap in no bit,
/// so that the last one that is not zero has the sign.
int sign_of_sum(const std::array<double, 6>& terms) {
  double rough = 0, magnitude = 0;
  for (const double term : terms) {
    rough += term;
    magnitude += std::abs(term);
  }
  // Five roundings, each of at most 2^-53 of the magnitude, and those of the magnitude itself.
  if (std::abs(rough) > 0x1p-49 * magnitude) return sign(rough);

  std::array<double, 6> parts{};
  for (std::size_t size = 0; size < terms.size(); ++size) {
    double carried = terms[size];
    for (std::size_t p = 0; p < size; ++p) {
      const double sum = carried + parts[p];
      const double of_part = sum - carried;
      parts[p] = (carried - (sum - of_part)) + (parts[p] - of_part);
      carried = sum;
    }
    parts[size] = carried;
  }
  for (std::size_t p = parts.size(); p-- > 0;)
    if (parts[p] != 0) return sign(parts[p]);
  return 0;
}

/// Returns 1 where the path a, b, c turns left, -1 where it turns right, 0 on a line; exactly.
int turn(const Point& a, const Point& b, const Point& c) {
  return sign_of_sum({a.x * b.y, -(a.y * b.x), b.x * c.y, -(b.y * c.x), c.x * a.y, -(c.y * a.x)});
}

/// Drops the axis along which the face's normal is longest. The face then turns left.
std::vector<Point> seen_along_normal(std::span<const Vec3> vertices, std::span<const std::uint32_t> corners) {
  const auto coordinates = [&](std::size_t corner) -> std::array<double, 3> {
    const Vec3& v = vertices[corners[corner]];
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
  };
  const std::array<double, 3> start = coordinates(0);
  std::array<double, 3>
      normal{};  // Newell's, from the first corner, so that it is as exact far from the origin
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::array<double, 3> a = coordinates(i), b = coordinates((i + 1) % corners.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      normal[axis] += (a[u] - b[u]) * ((a[v] - start[v]) + (b[v] - start[v]));
    }
  }
  std::size_t axis = 2;
  for (const std::size_t other : {1, 0})
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  std::size_t across = (axis + 1) % 3, upward = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(across, upward);

  std::vector<Point> points;
  points.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    points.push_back({coordinates(i)[across], coordinates(i)[upward]});
  return points;
}

/// Cuts ears off a polygon.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Point> points)
      : points_(std::move(points)), before_(points_.size()), behind_(points_.size()) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      behind_[i] = (i + 1) % points_.size();
      before_[behind_[i]] = i;
    }
  }

  /// Calls use(a, b, c) for the corners of each triangle.
  template <class Use>
  void cut(Use use) {
    std::size_t from = 0;
    for (std::size_t left = points_.size(); left > 3; --left) {
      const std::size_t ear = best_ear(from, left);
      use(before_[ear], ear, behind_[ear]);
      from = behind_[ear];
      behind_[before_[ear]] = behind_[ear];
      before_[behind_[ear]] = before_[ear];
    }
    use(before_[from], from, behind_[from]);
  }

 private:
  std::vector<Point> points_;
  std::vector<std::size_t> before_, behind_;  ///< of each corner that is left, its neighbours

  /// What is wrong with a corner as an ear. A simple polygon always has one that is clear; one that touches or crosses itself
  /// may have none.
  enum Fault { clear, without_area, touched, entered, outside };

  /// Returns the first corner of the least fault.
  std::size_t best_ear(std::size_t from, std::size_t left) const {
    std::size_t best = from, corner = from;
    Fault least = outside;
    for (std::size_t i = 0; i < left && least != clear; ++i, corner = behind_[corner]) {
      const Fault fault = fault_of(corner);
      if (fault >= least) continue;
      least = fault;
      best = corner;
    }
    return best;
  }

  Fault fault_of(std::size_t ear) const {
    const std::array<Point, 3> triangle = {points_[before_[ear]], points_[ear], points_[behind_[ear]]};
    const int side = turn(triangle[0], triangle[1], triangle[2]);
    if (side == 0) return goes_on(triangle) ? without_area : clear;
    if (side < 0) return outside;
    Fault fault = clear;
    for (std::size_t i = behind_[ear]; i != before_[ear]; i = behind_[i]) {
      const Point &a = points_[i], &b = points_[behind_[i]];
      if (apart(triangle, a, b)) continue;
      if (enters(triangle, a, b)) return entered;
      if (touches(triangle, a) || runs_back(triangle[0], triangle[1], a, b) ||
          runs_back(triangle[1], triangle[2], a, b))
        fault = touched;
    }
    return fault;
  }

  /// Returns whether the segment from a to b, or a part of it, goes back along that from s to t. Then there may be no inside next to it.
  static bool runs_back(const Point& s, const Point& t, const Point& a, const Point& b) {
    if (turn(s, t, a) != 0 || turn(s, t, b) != 0) return false;
    const auto meets = [&](double Point::*axis) {
      const bool rises = s.*axis < t.*axis;
      const double low = rises ? s.*axis : t.*axis, high = rises ? t.*axis : s.*axis;
      return low < high && (rises ? a.*axis > b.*axis : a.*axis < b.*axis) &&
             std::min(a.*axis, b.*axis) < high && std::max(a.*axis, b.*axis) > low;
    };
    return meets(&Point::x) || meets(&Point::y);
  }

  /// Of three corners on a line: returns whether the middle one lies between the others. Else nothing is lost with it.
  static bool goes_on(const std::array<Point, 3>& t) {
    const auto between = [&](double Point::*axis) {
      return (t[0].*axis < t[1].*axis && t[1].*axis < t[2].*axis) ||
             (t[0].*axis > t[1].*axis && t[1].*axis > t[2].*axis);
    };
    return between(&Point::x) || between(&Point::y);
  }

  /// Tells most edges from the triangle at little cost.
  static bool apart(const std::array<Point, 3>& t, const Point& a, const Point& b) {
    const auto is_separate = [&](double Point::*axis) {
      return std::max(a.*axis, b.*axis) < std::min({t[0].*axis, t[1].*axis, t[2].*axis}) ||
             std::min(a.*axis, b.*axis) > std::max({t[0].*axis, t[1].*axis, t[2].*axis});
    };
    return is_separate(&Point::x) || is_separate(&Point::y);
  }

  /// Returns whether a segment has a point inside the triangle: no line along an edge, or along the segment, parts the two.
  static bool enters(const std::array<Point, 3>& t, const Point& a, const Point& b) {
    for (std::size_t i = 0; i < 3; ++i)
      if (turn(t[i], t[(i + 1) % 3], a) <= 0 && turn(t[i], t[(i + 1) % 3], b) <= 0) return false;
    if (a == b) return true;
    const int sides[] = {turn(a, b, t[0]), turn(a, b, t[1]), turn(a, b, t[2])};
    return std::ranges::min(sides) < 0 && std::ranges::max(sides) > 0;
  }

  /// Returns whether a point lies on the triangle but at no corner. Corners may repeat, as along a cut to a hole.
  static bool touches(const std::array<Point, 3>& t, const Point& p) {
    if (p == t[0] || p == t[1] || p == t[2]) return false;
    return turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0;
  }
};

/// Returns the corner of a quadrilateral from which its diagonal is drawn: the one that is not convex, where there is one.
std::size_t start_of_diagonal(const std::vector<Point>& quad) {
  for (std::size_t i = 0; i < 4; ++i)
    if (turn(quad[(i + 3) % 4], quad[i], quad[(i + 1) % 4]) <= 0) return i;
  return 0;
}

}  // namespace

void append_triangles_of(std::span<const Vec3> vertices, std::span<const std::uint32_t> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back({corners[a], corners[b], corners[c]});
  };
  if (corners.size() == 3) return add(0, 1, 2);
  const std::vector<Point> points = seen_along_normal(vertices, corners);
  if (corners.size() == 4) {
    const std::size_t start = start_of_diagonal(points);
    add(start, (start + 1) % 4, (start + 2) % 4);
    add(start, (start + 2) % 4, (start + 3) % 4);
  } else {
    EarClipper(points).cut(add);
  }
}

}  // namespace bch::detail::importing
