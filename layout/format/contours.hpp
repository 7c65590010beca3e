// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include <bch/outline.hpp>

namespace bch::detail {

/// Returns at least the largest distance of a point from the origin.
double reach(std::span<const Vec2> points);

/// Returns the contour with the largest area, the first of several.
/// Precondition: there is one.
std::span<const Vec2> largest_contour(const Outline& outline);

/// Returns twice the area inside a contour, square metres; negative where it is clockwise.
double twice_area(std::span<const Vec2> contour);

}  // namespace bch::detail
