// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/hierarchy/hierarchy.hpp"

namespace bch::test {

/// At every node: all vertices of its elements lie in its disc (in double), the children divide its elements
/// and neither is empty, and its bounding radius holds the discs of all nodes below.
void expect_sound(const Hierarchy& hierarchy);

/// The pieces of every outline segment lead from its one end to the other, and every cut holds all elements.
void expect_covers_outline(const Hierarchy& hierarchy, const Outline& outline);

/// No leaf's disc is larger than the threshold, but for the rounding.
void expect_leaves_below(const Hierarchy& hierarchy, float threshold);

}  // namespace bch::test
