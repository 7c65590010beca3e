// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/agents.hpp>

#include "kernel/simd/arguments.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns whether a contour holds a point that is not on it; both are in the shape's frame.
bool contour_holds(const Vec2* points, const Contour& contour, PointIn<double> p) noexcept;

/// Returns whether a contour of one agent lies inside the other's, for two agents whose cuts do not overlap.
///
/// Outlines then do not meet, so one point of a contour speaks for all of it. And the answer does not hang on
/// a rounding: discs that the float test keeps apart leave u S and more between any two outline points
/// (layout/base/rounding.hpp), while this test, in double, is off by less than 1e-9 S.
/// Preconditions: valid indices; the set keeps outlines.
bool one_contains_other(const Arguments& in, Pair pair) noexcept;

}  // namespace bch::detail
