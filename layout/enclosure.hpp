// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/outline.hpp"
#include "layout/shape_set_view.hpp"

namespace bch {

/// The smallest disc about an outline, for two questions about a pair: do they stand so near each other that they
/// probably collide, and may a contour of one lie inside a contour of the other?
///
/// A set with enclosing disc (a, r) inside a disc (b, R) has |a - b|^2 + r^2 <= R^2: the points that hold its disc in
/// place do not fit into any half of it, so one of them is at least sqrt(|a - b|^2 + r^2) away from b. That speaks
/// of one contour; of a shape with several, nothing is known.
/// Preconditions: validate(outline) does not throw. `reach` is that of the shape, metres.
Enclosure enclosure(const Outline& outline, double reach);

}  // namespace bch
