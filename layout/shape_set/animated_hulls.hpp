// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "layout/base/plane_point.hpp"

namespace bch::detail {

struct AnimatedTreeChunk;

constexpr std::uint32_t hull_directions = 32;

/// A hull bounds a body in hull_directions directions. Besides the hull of the whole body, spheres have one for each of
/// hull_bands bands of height, between planes hull_band metres apart above the agent's ground. The first band extends
/// to below all spheres, the last to above all. The hull of a band contains the spheres that come into the band or
/// within hull_overlap of it.
///
/// So two bodies need to be compared only in pairs of bands with more than hull_overlap of height in common. Proof:
/// each of two bodies that meet has a band that contains the height of a common point. If these two bands have less in
/// common, the point is within hull_overlap of the end of one. The next band of that body contains the sphere, too, and
/// has more height in common with the other band.
constexpr std::uint32_t hull_bands = 8;
constexpr double hull_band = 0.25, hull_overlap = 0.01;
static_assert(hull_band > 2 * hull_overlap);

/// Bounds the extents of a body in an interval of time, per direction, as multiples of AnimatedHulls::step. At a time
/// in the interval, the bound is the linear interpolation of `from`, at the start, and `to`, at the end.
struct HullInterval {
  struct Extent {
    std::int16_t from, to;
  };
  double begin, end;  ///< seconds of the clip
  using Extents = std::array<Extent, hull_directions>;
  Extents extents;
};

/// Holds the hulls of the bands in an interval. Bit b of `occupied` says that band b contains spheres; the others
/// contain nothing.
struct HullBands {
  std::array<HullInterval::Extents, hull_bands> extents;
  std::uint32_t occupied = 0;
};

/// Holds the hulls of a body in intervals of time. At level 0 an interval is one chunk; at each further level it is two
/// of the level below.
struct AnimatedHulls {
  static constexpr unsigned level_count = 4;

  double step = 0;  ///< metres
  std::array<std::vector<HullInterval>, level_count> levels;
  std::array<std::vector<HullBands>, level_count> bands;  ///< for bodies of spheres: one per interval
};

/// Returns a direction by its number. The ends of these vectors are evenly spaced on the border of the square from -1
/// to 1, so any other direction is a linear interpolation of two neighbours.
constexpr PlanePoint hull_direction(std::uint32_t k) noexcept {
  constexpr std::uint32_t of_side = hull_directions / 4;
  const double along = 2.0 * (k % of_side) / of_side - 1;
  switch (k / of_side) {
    case 0:
      return {1, along};
    case 1:
      return {-along, 1};
    case 2:
      return {-1, -along};
    default:
      return {along, -1};
  }
}

/// Represents any direction as `size` * ((1 - fraction) * hull_direction(first) + fraction * hull_direction(second)).
struct HullDirection {
  std::uint32_t first, second;
  double fraction, size;

  /// Takes a vector other than 0.
  explicit HullDirection(const PlanePoint& d) noexcept {
    constexpr std::uint32_t of_side = hull_directions / 4;
    const bool along_x = std::abs(d.x) >= std::abs(d.y);
    const double longer = along_x ? d.x : d.y, slope = along_x ? d.y / d.x : -d.x / d.y;
    const double place = (slope + 1) * (of_side / 2.0);
    const auto whole = static_cast<std::uint32_t>(place);
    first = (whole + (along_x ? 0 : of_side) + (longer > 0 ? 0 : 2 * of_side)) % hull_directions;
    second = (first + 1) % hull_directions;
    fraction = place - whole;
    size = std::abs(longer);
  }

  /// Bounds the dot product of the vector with the body's points, at the start and the end of an interval.
  struct Extent {
    double from, to;
  };
  /// Returns an upper bound: the extent in the sum of two directions is at most the sum of the extents in each.
  Extent extent(const HullInterval::Extents& extents) const noexcept {
    const HullInterval::Extent a = extents[first], b = extents[second];
    return {size * (a.from + (b.from - a.from) * fraction), size * (a.to + (b.to - a.to) * fraction)};
  }
};

/// Computes the hulls of consecutive chunks.
AnimatedHulls animated_hulls(const std::vector<AnimatedTreeChunk>& chunks, double max_extent);

}  // namespace bch::detail
