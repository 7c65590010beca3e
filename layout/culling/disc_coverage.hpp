// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>

#include "layout/culling/tangent_discs.hpp"

namespace bch::detail {

/// Chooses discs one after the other: each adds the most area to the union of the discs chosen before, all of them
/// dilated. Area is counted on a raster of 32 x 32 unit cells from the origin, one bit per cell.
class DiscCoverage {
 public:
  static constexpr std::uint32_t cells = raster_rows;

  /// Begins a new choice among these discs, in units of a cell.
  void offer(const InteriorLoops& loops, const CandidateDiscs& discs, float dilation);
  /// Returns the best of the remaining discs, of which there must be at least one, and removes it.
  std::uint32_t choose();

 private:
  using Mask = std::array<std::uint32_t, cells>;  ///< one bit per cell, one word per row
  static constexpr std::int32_t gone = -1;

  static std::int32_t promise(std::uint32_t disc, int gain);

  const InteriorLoops* loops_ = nullptr;
  alignas(64) std::array<Mask, max_touches> mask_;
  alignas(64) Mask covered_;
  /// An upper bound of the cells that a disc would add (gains only shrink as others are chosen), with the number of
  /// the disc in the low bits, so that the maximum names the disc.
  alignas(64) std::array<std::int32_t, max_touches> promise_;
};

}  // namespace bch::detail
