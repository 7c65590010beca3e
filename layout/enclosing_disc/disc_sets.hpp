// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Represents consecutive points.
struct PointRange {
  std::uint32_t begin, end;
};

/// Represents a disc like EnclosingDisc, with the radius squared.
struct SolvedDisc {
  Vec2 centre;
  double square_radius;
};

/// The multiple of the squared radius beyond which a point counts as outside. If it were closer to 1 than the
/// rounding of a circumcentre, pivoting might never end.
constexpr double disc_slack = 1 + 1e-13;
/// The most pivots per disc. Each enlarges the disc, and ten suffice in practice. Even if pivoting ends early, the
/// disc contains all points, because the last scan sets its radius.
constexpr int max_disc_pivots = 100;

/// Holds the arguments of the loops behind EnclosingDiscs: plain pointers, because no function of the standard
/// library may be compiled for wide registers.
struct DiscSets {
  const Vec2* points;
  const PointRange* sets;
  const std::uint32_t* order;  ///< indices of the sets, ascending by size
  std::size_t small_count;     ///< the number of sets of at most four points
  std::size_t count;
  double* scratch;  ///< memory for the points of the largest set, disc_set_lanes times
  SolvedDisc* discs;
};

/// The number of lanes of the widest registers.
constexpr std::size_t disc_set_lanes = 4;

}  // namespace bch::detail
