// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/outline.hpp>

#include "tests/support/outline_checks.hpp"

namespace bch::test {

/// Compares an outline with what libpolyclipping, an independent implementation, makes of the same triangles,
/// each inflated by a step of the outline's grid (so that what has no area gets some, and what touches
/// overlaps): every corner of the outline is inside the inflated one, and the areas differ by no more than a
/// band of 4 steps along the boundary.
void expect_equals_inflated_union(const Outline& outline, Positions positions, Triangles triangles);

}  // namespace bch::test
