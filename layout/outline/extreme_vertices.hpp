// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

#include "layout/outline/grid_geometry.hpp"

namespace bch::detail {

/// Finds the few vertices of a mesh, in pose after pose, that decide the single disc around it and its reach:
/// corners of its convex hull, which need no outline. They are snapped to the grid of outlines
/// (outline_builder.hpp), so that the disc around them is the disc around the outline. It may differ in two
/// ways only: a whole triangle seen as a point counts here, and a crossing on the hull is rounded beyond it
/// there, both within the grid's share of a disc's margin.
class ExtremeVertices {
 public:
  /// Takes the triangles of all poses.
  /// Shapes:  triangle indices are below `vertices`, and there is a triangle.
  ExtremeVertices(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices);

  /// Finds those of a pose. Allocates nothing once a pose had the most of them.
  /// Units:   metres; the ground is x-y.
  /// Errors:  throws std::invalid_argument on a coordinate that is not finite or a reach outside the domain of
  ///          rounding.hpp.
  void find(std::span<const Vec2> positions);

  std::span<const Vec2> points() const { return points_; }  ///< one at least
  float grid_step() const { return static_cast<float>(step_); }

 private:
  std::size_t farthest_from(double x, double y, std::vector<float>& squares) const;
  void keep(float from_middle, float from_origin);

  std::vector<std::uint32_t> used_;
  std::vector<GridPoint> grid_;  ///< up to whole blocks filled with the last vertex
  /// The squares of the vertices' distances, in steps of the grid.
  std::vector<float> from_origin_, from_middle_;
  std::vector<Vec2> points_;
  double step_ = 0;
};

}  // namespace bch::detail
