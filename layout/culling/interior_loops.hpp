// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Describes the points of a contour. The structs of this file are the arguments of the loops in interior_lanes.hpp:
/// plain pointers, because no function of the standard library may be compiled for wide registers.
struct ContourPoints {
  const float *x, *y;
  std::size_t count;
};

/// Holds points, one per lane. Whole registers are read and written, but only the first `count` lanes matter. The
/// arrays have max_touches elements.
struct PointLanes {
  const float *x, *y;
  std::uint32_t count;
};
struct TouchLanes {
  const float *x, *y, *normal_x, *normal_y;
  std::uint32_t count;
};

/// Holds contour_lines directions, one per lane, and the indices of the points that are the least and the farthest
/// along each.
constexpr std::uint32_t contour_lines = 8;
struct LineLanes {
  const double *cosine, *sine;
  double *lowest, *highest;  ///< indices; the first of several points
};

/// The rows of a raster: one word per row, one bit per cell.
constexpr std::uint32_t raster_rows = 32;

/// Holds the functions of one compilation of interior_lanes.hpp, which documents them.
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
