// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/agents.hpp>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns whether a contour of one agent's outline lies inside the other's outline, for two agents whose
/// cuts do not overlap.
///
/// Outlines then do not meet, so one point of a contour speaks for all of it. And the answer does not hang on
/// a rounding: discs that the float test keeps apart leave u S and more between any two outline points
/// (layout/base/rounding.hpp), while this test, in double, is off by less than 1e-9 S.
/// Preconditions: valid indices; the set was planned for the solid semantics.
bool one_contains_other(const ShapeSetView& shapes, const Agents& agents, Pair pair) noexcept;

}  // namespace bch::detail
