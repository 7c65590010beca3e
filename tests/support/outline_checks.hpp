// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

using Positions = std::span<const Vec3>;
using Triangles = std::span<const std::array<std::uint32_t, 3>>;

/// Returns whether a point is inside by the even-odd rule over all contours.
bool inside(const Outline& outline, double x, double y);

/// Returns how far a point is from the nearest edge of all contours, metres.
double distance_to(const Outline& outline, double x, double y);

/// Checks that every vertex of every triangle is inside the outline or within 1.5 grid steps of it, and so
/// are points along the edges.
void expect_covers(const Outline& outline, Positions positions, Triangles triangles);

}  // namespace bch::test
