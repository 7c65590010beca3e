// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>
#include <bch/outline.hpp>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Holds the support heights, the largest extent of a set of discs along each of support_directions directions:
/// direction k is at angle k * 2 pi / support_directions. First all even directions, then all odd ones, each
/// twice over, so that a turned set is an offset into the same array and half of the directions is one load.
///
/// Two sets are apart when along some direction the sum of their supports is less than the distance of their
/// origins. Between two directions a support is at most that of the corner where the two supporting lines
/// meet; rounding.hpp says how much the heights are enlarged so that the float test never separates discs
/// that the float test of discs lets overlap, nor segments that meet.
using Supports = std::array<float, support_stride>;

/// Holds the points of an outline as discs without a radius.
struct PointDiscs {
  /// Takes an outline in place of the last one, and keeps the memory.
  void assign(const Outline& outline);

  std::uint32_t count() const noexcept { return static_cast<std::uint32_t>(x.size()); }

  std::vector<float> x, y, radius;
};

/// Computes the supports of discs. `reach` is that of rounding.hpp, in metres.
Supports supports(std::span<const Disc> discs, double reach);

/// Computes the supports of one disc or more in arrays.
Supports supports(const float* x, const float* y, const float* radius, std::uint32_t count, double reach);

}  // namespace bch::detail
