// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Holds what the loops behind interior.hpp work on: plain pointers, because nothing of the standard library may be
/// compiled for wide registers.
struct ContourPoints {
  const float *x, *y;
  std::size_t count;
};

/// Holds points that each have a lane: whole registers are read and written, of which only the first `count` lanes
/// matter. Their arrays have room for max_touches.
struct PointLanes {
  const float *x, *y;
  std::uint32_t count;
};
struct TouchLanes {
  const float *x, *y, *normal_x, *normal_y;
  std::uint32_t count;
};

/// Directions that each have a lane, contour_lines of them, and which points are least and farthest along each.
constexpr std::uint32_t contour_lines = 8;
struct LineLanes {
  const double *cosine, *sine;
  double *lowest, *highest;  ///< indices; of several points the first
};

/// A raster's words, each a row and a bit for each of its cells.
constexpr std::uint32_t raster_rows = 32;

/// Represents one compilation of interior_lanes.hpp, which says what the loops do.
struct InteriorLoops {
  void (*keep_out)(const ContourPoints& points, const TouchLanes& touches, float* half_curvature) noexcept;
  void (*measure)(const Vec2* contour, std::size_t count, const PointLanes& from, double* square,
                  double* turns) noexcept;
  void (*estimate)(const ContourPoints& contour, const PointLanes& from, float* square,
                   float* turns) noexcept;
  void (*find_nearest)(const ContourPoints& contour, const PointLanes& from, float* square,
                       std::int32_t* edge) noexcept;
  void (*find_extremes)(const Vec2* contour, std::size_t count, const LineLanes& lines) noexcept;
  std::int32_t (*draw)(float x, float y, float radius, std::uint32_t* rows) noexcept;
  std::int32_t (*count_new)(const std::uint32_t* rows, const std::uint32_t* covered) noexcept;
};

}  // namespace bch::detail
