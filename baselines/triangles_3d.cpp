// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <optional>
#include <utility>

#include "baselines/exact_tests.hpp"

namespace bch::baselines {
namespace {

using Signs = std::array<int, 3>;

/// Returns on which side of the plane of s the corners of t are; zeros if s has no area.
Signs sides(const Triangle3& s, const Triangle3& t) {
  return {orientation(s[0], s[1], s[2], t[0]), orientation(s[0], s[1], s[2], t[1]),
          orientation(s[0], s[1], s[2], t[2])};
}

bool one_side(const Signs& signs) {
  return signs[0] != 0 && signs[0] == signs[1] && signs[1] == signs[2];
}
bool all_zero(const Signs& signs) {
  return signs[0] == 0 && signs[1] == 0 && signs[2] == 0;
}

/// Rotates t so that its first corner is alone on a closed side of a plane and the others on the opposite
/// one. Returns that side. For signs that are neither all zero nor all the same.
int isolate(Triangle3& t, const Signs& signs) {
  const int sum = signs[0] + signs[1] + signs[2];
  const auto rotate_to = [&](std::ptrdiff_t first) { std::rotate(t.begin(), t.begin() + first, t.end()); };
  // (+ + 0): the zero is alone on the negative side; (+ + -), (+ - -), (+ 0 0): one sign occurs once;
  // (+ 0 -): either would do.
  const int alone = sum == 2 || sum == -2                              ? 0
                    : sum == 0                                         ? 1
                    : std::count(signs.begin(), signs.end(), sum) == 1 ? sum
                                                                       : -sum;
  rotate_to(std::find(signs.begin(), signs.end(), alone) - signs.begin());
  return alone != 0 ? alone : sum > 0 ? -1 : 1;
}

/// Planes that are neither parallel nor of triangles without area, and neither triangle on one side: both
/// cut the planes' common line in an interval. Guigue and Devillers: with each first corner alone on the
/// positive side of the other's plane, two determinants tell whether the intervals overlap.
bool intervals_meet(Triangle3 s, const Signs& s_sides, Triangle3 t, const Signs& t_sides) {
  const int side_s = isolate(s, s_sides), side_t = isolate(t, t_sides);
  if (side_s < 0) std::swap(t[1], t[2]);
  if (side_t < 0) std::swap(s[1], s[2]);
  return orientation(s[1], t[0], s[0], t[1]) <= 0 && orientation(s[0], t[0], s[2], t[2]) <= 0;
}

/// Drops x, y or z.
Point2 project(const Point3& p, int dropped) {
  return dropped == 0 ? Point2{p.y, p.z} : dropped == 1 ? Point2{p.z, p.x} : Point2{p.x, p.y};
}
Triangle2 project(const Triangle3& t, int dropped) {
  return {project(t[0], dropped), project(t[1], dropped), project(t[2], dropped)};
}

/// A projection along which the three points stay off one line, if they are off one.
std::optional<int> faithful_projection(const Point3& a, const Point3& b, const Point3& c) {
  for (const int dropped : {0, 1, 2})
    if (orientation(project(a, dropped), project(b, dropped), project(c, dropped)) != 0) return dropped;
  return std::nullopt;
}

bool boxes_meet(const Point3& a, const Point3& b, const Point3& p, const Point3& q) {
  const auto meet = [](double a_, double b_, double p_, double q_) {
    return std::max(a_, b_) >= std::min(p_, q_) && std::max(p_, q_) >= std::min(a_, b_);
  };
  return meet(a.x, b.x, p.x, q.x) && meet(a.y, b.y, p.y, q.y) && meet(a.z, b.z, p.z, q.z);
}

bool segments_meet_in_space(const Point3& a, const Point3& b, const Point3& p, const Point3& q) {
  if (!boxes_meet(a, b, p, q) || orientation(a, b, p, q) != 0) return false;
  const Point3* const triples[][3] = {{&a, &b, &p}, {&a, &b, &q}, {&p, &q, &a}, {&p, &q, &b}};
  for (const auto& [u, v, w] : triples)
    if (const auto dropped = faithful_projection(*u, *v, *w))
      return segments_meet({project(a, *dropped), project(b, *dropped)},
                           {project(p, *dropped), project(q, *dropped)});
  return true;  // on one line, where boxes meet exactly if intervals do
}

bool segment_meets(const Point3& p, const Point3& q, const Triangle3& t) {
  const auto plane = faithful_projection(t[0], t[1], t[2]);
  if (!plane)
    return segments_meet_in_space(p, q, t[0], t[1]) || segments_meet_in_space(p, q, t[1], t[2]) ||
           segments_meet_in_space(p, q, t[2], t[0]);
  const int side_p = orientation(t[0], t[1], t[2], p), side_q = orientation(t[0], t[1], t[2], q);
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {
    const Point2 from = project(p, *plane), to = project(q, *plane);
    return triangles_meet(Triangle2{from, to, to}, project(t, *plane));
  }
  const int u = orientation(p, q, t[0], t[1]), v = orientation(p, q, t[1], t[2]),
            w = orientation(p, q, t[2], t[0]);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Two triangles meet exactly if an edge of one meets the other: slower, but for any triangles.
bool edges_meet(const Triangle3& s, const Triangle3& t) {
  for (std::size_t i = 0; i < 3; ++i)
    if (segment_meets(s[i], s[(i + 1) % 3], t) || segment_meets(t[i], t[(i + 1) % 3], s)) return true;
  return false;
}

}  // namespace

bool triangles_meet(const Triangle3& s, const Triangle3& t) noexcept {
  const Signs t_sides = sides(s, t);
  if (one_side(t_sides)) return false;
  const Signs s_sides = sides(t, s);
  if (one_side(s_sides)) return false;
  if (all_zero(s_sides) || all_zero(t_sides)) return edges_meet(s, t);
  return intervals_meet(s, s_sides, t, t_sides);
}

}  // namespace bch::baselines
