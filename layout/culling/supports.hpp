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

/// Holds the supports of a set of discs: its largest extent along each of support_directions directions. Direction k
/// has the angle k * 2 pi / support_directions. First come all even directions, then all odd ones, so that half of
/// the directions are loaded at once. Each of the two lists is stored twice in succession, so that a rotation of the
/// set is an offset into the array.
///
/// Two sets are disjoint if along some direction the sum of their supports is less than the distance of their
/// origins. Between two directions, the support is at most that of the corner where the two supporting lines meet.
/// rounding.hpp derives how much supports are enlarged, so that supports compared in float never separate two discs
/// that the float test of discs accepts, nor two segments that meet.
using Supports = std::array<float, support_stride>;

/// Holds the points of an outline as discs of radius 0.
struct PointDiscs {
  /// Takes an outline in place of the previous one, reusing memory.
  void assign(const Outline& outline);

  std::uint32_t count() const noexcept { return static_cast<std::uint32_t>(x.size()); }

  std::vector<float> x, y, radius;
};

/// Computes the supports of discs. `max_extent` is that of rounding.hpp, in metres.
Supports supports(std::span<const Disc> discs, double max_extent);

/// Computes the supports of one or more discs in parallel arrays.
Supports supports(const float* x, const float* y, const float* radius, std::uint32_t count,
                  double max_extent);

}  // namespace bch::detail
