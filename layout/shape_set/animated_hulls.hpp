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

/// Bodies of spheres have hulls for bands of height as well, so many, between planes that are so far apart above the agent's ground: the
/// first one reaches from below, the last one to above all. A band's hull holds the spheres that come into it or within an overlap of it.
///
/// So two bodies need be compared in bands alone that have more height in common than the overlap: a point of both is in a band of each.
/// Where these two have less in common, the point is within the overlap of the next band of that body whose band ends there. That one has
/// more in common with the other body's.
constexpr std::uint32_t hull_bands = 8;
constexpr double hull_band = 0.25, hull_overlap = 0.01;
static_assert(hull_band > 2 * hull_overlap);

/// Says how far a body reaches through an interval of time in each of the directions, in steps: at every time of it by no more than what lies
/// evenly between both ends.
struct HullInterval {
  struct Extent {
    std::int16_t from, to;
  };
  double begin, end;  ///< seconds of the clip
  using Extents = std::array<Extent, hull_directions>;
  Extents extents;
};

/// Holds the hulls of the bands through an interval, of those that have a bit in `occupied`; there is nothing in the others.
struct HullBands {
  std::array<HullInterval::Extents, hull_bands> extents;
  std::uint32_t occupied = 0;
};

/// Holds the hulls of a body through intervals of time, of one chunk each at level 0, and of two intervals of the level below at the next ones.
struct AnimatedHulls {
  static constexpr unsigned level_count = 4;

  double step = 0;  ///< metres
  std::array<std::vector<HullInterval>, level_count> levels;
  std::array<std::vector<HullBands>, level_count> bands;  ///< of spheres, by interval
};

/// Returns a direction by its number. Their ends lie evenly on the border of the square from -1 to 1, so that those of others lie
/// between two of them, evenly, too.
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

/// Represents a direction between two of those: `size` times (1 - fraction) of `first` and fraction of `second`.
struct HullDirection {
  std::uint32_t first, second;
  double fraction, size;

  /// Takes a vector that is not 0.
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

  /// Says how far a body reaches in this direction at both ends of an interval, times its length.
  struct Extent {
    double from, to;
  };
  /// Returns that at most: a body reaches no farther in the sum of two directions than the sum of how far it does in each.
  Extent extent(const HullInterval::Extents& extents) const noexcept {
    const HullInterval::Extent a = extents[first], b = extents[second];
    return {size * (a.from + (b.from - a.from) * fraction), size * (a.to + (b.to - a.to) * fraction)};
  }
};

/// Finds the hulls of chunks that follow each other.
AnimatedHulls animated_hulls(const std::vector<AnimatedTreeChunk>& chunks, double reach);

}  // namespace bch::detail
