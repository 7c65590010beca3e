// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/hierarchy.hpp>

#include "layout/hierarchy/paper_hierarchies.hpp"

namespace bch::test {

/// Builds what contour_hierarchy() defines, word by word: node after node by recursion, discs by Welzl's
/// algorithm. Validates nothing.
Hierarchy reference_hierarchy(const Outline& outline, float threshold, detail::SplitRule rule);

/// Expects the same tree over the same primitives, and discs as large up to a 1e-6 part and the rounding of
/// their centres.
void expect_same_tree(const Hierarchy& hierarchy, const Hierarchy& reference);

}  // namespace bch::test
