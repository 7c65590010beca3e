// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>

#include "layout/culling/tangent_discs.hpp"

namespace bch::detail {

/// Chooses discs one after the other, each to add the most area to the union of those chosen so far, all of
/// them dilated. Area is counted on a raster of 32 x 32 unit cells from the origin, a bit each.
class DiscCoverage {
 public:
  static constexpr std::uint32_t cells = raster_rows;

  /// Begins anew with these discs to choose from, in units of a cell.
  void offer(const InteriorLoops& loops, const CandidateDiscs& discs, float dilation);
  /// Returns the best of the discs that are left; they have to be one at least. It is covered and gone from then on.
  std::uint32_t choose();

 private:
  using Mask = std::array<std::uint32_t, cells>;  ///< a bit a cell, a word a row
  static constexpr std::int32_t gone = -1;

  static std::int32_t promise(std::uint32_t disc, int gain);

  const InteriorLoops* loops_ = nullptr;
  alignas(64) std::array<Mask, max_touches> mask_;
  alignas(64) Mask covered_;
  /// The cells that a disc would add, at most: gains only shrink as others are chosen. In the low bits the
  /// disc, so that the largest of these numbers names it.
  alignas(64) std::array<std::int32_t, max_touches> promise_;
};

}  // namespace bch::detail
