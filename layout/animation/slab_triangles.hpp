// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/character.hpp>

#include "layout/base/plane_point.hpp"
#include "layout/character/motion_bounds.hpp"
#include "layout/character/skinning.hpp"

namespace bch::detail {

/// Holds the triangles of a body, or pieces of these: corners beyond its vertices are the middles of two, of vertices or
/// middles before.
struct MovingMesh {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> middles;

  /// Appends the middles to the vertices of a pose.
  template <class Point>
  void append_middles(std::vector<Point>& points) const {
    for (const auto& [a, b] : middles) points.push_back(middle(points[a], points[b]));
  }

  static Vec2 middle(const Vec2& a, const Vec2& b) { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }
  static PlanePoint middle(const PlanePoint& a, const PlanePoint& b) { return 0.5 * (a + b); }
  static Vec3 middle(const Vec3& a, const Vec3& b) {
    return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
  }
};

/// Tells what of a clip's triangles reaches into a slab at some time of an interval.
///
/// Heights are looked at in short windows, in each of which a vertex leaves the chord between its ends by at most A h^2 / 8: h is the
/// window's length, and A bounds the acceleration. A middle is at every time half-way between two points, and so are the bounds of its height.
/// A triangle is as low as its lowest corner is and as high as its highest one, each at any time of the interval. Triangles that are not
/// in the slab as wholes are halved where they are longest, and pieces left out, down to small ones.
class SlabTriangles {
 public:
  /// Takes a character, which must outlive this. Edges of pieces that are not halved are shorter than `least_edge`, metres, in the bind
  /// pose.
  /// Errors:  throws std::invalid_argument as MotionBounds does.
  SlabTriangles(const Character& character, std::uint32_t clip, double least_edge);

  /// Looks at an interval of the clip.
  void look(float from, float to);
  /// Returns the triangles and pieces that reach into a slab at some time of the interval, or maybe do.
  MovingMesh in(const Heights& slab);
  /// Returns the most that a vertex rises or sinks in the interval that leaves the slab or comes into it, metres.
  double most_rise(const Heights& slab) const;
  /// Returns the heights that triangles take in the interval, rounded outward.
  Heights heights() const;

 private:
  using Triangle = std::array<std::uint32_t, 3>;

  void add(float seconds);
  void widen(double room);
  Heights heights_of(const Triangle& triangle) const;
  void add_pieces(const Triangle& triangle, const Heights& slab, MovingMesh& mesh);

  const Character& character_;
  std::uint32_t clip_;
  double least_edge_;
  MotionBounds bounds_;
  Skinner skinner_;
  std::vector<Heights> window_;    ///< per vertex: at both ends of a window
  std::vector<Heights> interval_;  ///< per vertex, then per middle
  std::vector<Vec3> bind_;         ///< likewise
  double reach_ = 0;
};

}  // namespace bch::detail
