// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

/// Checks every node: all vertices of its primitives lie in its disc (in double), the children divide its
/// primitives and neither is empty, and its bounding radius holds the discs of all nodes below.
void expect_sound(const Hierarchy& hierarchy);

/// Checks that the pieces of every outline segment lead from its one end to the other, and every cut holds
/// all primitives.
void expect_covers_outline(const Hierarchy& hierarchy, const Outline& outline);

/// Checks that no leaf's disc is larger than the threshold, except for the rounding.
void expect_leaves_below(const Hierarchy& hierarchy, float threshold);

}  // namespace bch::test
