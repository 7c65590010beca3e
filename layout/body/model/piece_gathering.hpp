// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>

#include "layout/body/model/skin_pieces.hpp"
#include "layout/body/model/sphere_fit.hpp"

namespace bch::detail {

/// Says what it costs to hand pieces over, in one unit.
struct GatheringCosts {
  /// Returns what it costs that a sphere takes a triangle.
  std::function<float(std::uint32_t sphere, const SphereFit::Corners& triangle)> price;
  /// Makes a sphere hold a triangle.
  std::function<void(std::uint32_t sphere, const SphereFit::Corners& triangle)> grow;
  float worth_of_corner;
};

/// Hands pieces to spheres that hold their neighbours, whole triangles where it can be, so that a pose has fewer corners to measure. No
/// sphere loses all of its pieces.
void gather_pieces(const SkinPieces& skin, SphereFit& fit, const GatheringCosts& costs);

}  // namespace bch::detail
