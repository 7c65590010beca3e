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

/// Finds the few vertices of a mesh, in pose after pose, that decide its extent and the smallest disc around it:
/// corners of its convex hull, for which no outline is needed. The vertices are snapped to the grid of outlines
/// (outline_builder.hpp), so that the disc around them is the disc around the outline. There are two exceptions, both
/// within the part of a disc's margin that belongs to the grid: triangles seen as a point count here, and in an
/// outline a crossing on the hull may be rounded to outside the hull.
class ExtremeVertices {
 public:
  /// Takes the triangles, which are the same in all poses.
  /// Shapes:  there is a triangle; triangle indices are below `vertices`.
  ExtremeVertices(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices);

  /// Finds the vertices of a pose. Allocates nothing once the pose with the most of them has been processed.
  /// Units:   metres; the ground is x-y.
  /// Errors:  throws std::invalid_argument if a coordinate is not finite or the extent is outside the domain of
  ///          rounding.hpp.
  void find(std::span<const Vec2> positions);

  std::span<const Vec2> points() const { return points_; }  ///< at least one
  float grid_step() const { return static_cast<float>(step_); }

 private:
  std::size_t farthest_from(double x, double y, std::vector<float>& squares) const;
  void keep(float from_middle, float from_origin);

  std::vector<std::uint32_t> used_;
  std::vector<GridPoint> grid_;  ///< padded by the last vertex to whole blocks
  /// The squared distances of the vertices, in grid steps.
  std::vector<float> from_origin_, from_middle_;
  std::vector<Vec2> points_;
  double step_ = 0;
};

}  // namespace bch::detail
