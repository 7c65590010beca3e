// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Represents a run of points.
struct PointRange {
  std::uint32_t begin, end;
};

/// Represents a disc like EnclosingDisc, with the radius squared.
struct SolvedDisc {
  Vec2 centre;
  double square_radius;
};

/// The fraction of a square radius beyond which a point counts as outside. If it were closer to 1 than the
/// rounding of a circumcentre, pivoting would never end.
constexpr double disc_slack = 1 + 1e-13;
/// The most pivots of a disc. Each enlarges it, and ten suffice in practice. The last scan makes the answer
/// safe even after these.
constexpr int max_disc_pivots = 100;

/// Holds what EnclosingDiscs asks of an instruction set: plain pointers, because nothing of the standard library
/// may be compiled for wide registers.
struct DiscSets {
  const Vec2* points;
  const PointRange* sets;
  const std::uint32_t* order;  ///< of the sets: by size
  std::size_t small_count;     ///< so many of them have at most four points
  std::size_t count;
  double* scratch;  ///< the largest set's points, disc_set_lanes times
  SolvedDisc* discs;
};

/// The number of lanes of the widest registers.
constexpr std::size_t disc_set_lanes = 4;

}  // namespace bch::detail
