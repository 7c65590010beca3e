// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/agents.hpp>

#include "kernel/simd/arguments.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns whether a contour contains a point that is not on it; both are in the shape's frame.
bool contour_contains(const Vec2* points, const Contour& contour, PointIn<double> p) noexcept;

/// Returns whether a contour of one agent lies inside the other's, for two agents whose cuts do not overlap.
///
/// Their outlines do not meet, so one point of a contour decides for the whole contour. Rounding cannot change that:
/// what the test of discs or of segments rejects is more than u S apart (layout/base/rounding.hpp), while this test, in
/// double, is off by less than 1e-9 S.
/// Preconditions: valid indices; the set keeps outlines.
bool one_contains_other(const Arguments& in, Pair pair) noexcept;

}  // namespace bch::detail
