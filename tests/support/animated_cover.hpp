// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

// What moving discs cover at a time, and what they leave out.

namespace bch::test {

/// Returns the discs of a body at a time of the clip.
std::vector<Disc> cover_at(const AnimatedDiscs& animated, double seconds);

/// Counts the vertices and the points of the outline's segments, some millimetres apart, that a cover does not hold.
std::size_t left_out(std::span<const Disc> cover, std::span<const Vec2> vertices, const Outline& outline);

/// Returns the largest coordinate of a cover in a direction, less that of what it covers.
double excess_in(std::span<const Disc> cover, std::span<const Vec2> vertices, double x, double y);

}  // namespace bch::test
