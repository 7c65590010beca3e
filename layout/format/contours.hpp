// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include <bch/outline.hpp>

namespace bch::detail {

/// Returns the largest distance of a point from the origin, or slightly more.
double max_extent(std::span<const Vec2> points);

/// Returns the contour with the largest area, the first of several.
/// Precondition: there is a contour.
std::span<const Vec2> largest_contour(const Outline& outline);

/// Returns twice the signed area of a contour, square metres; negative if it is clockwise.
double twice_area(std::span<const Vec2> contour);

}  // namespace bch::detail
