// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include <bch/pose_shape.hpp>

#include "layout/animation/contour.hpp"

namespace bch::detail {

/// Represents a contour at the time of a key, and how vertices on it move.
struct KeyContour {
  double time = 0;
  EvenContour way;
  std::vector<Vec2> here, next;  ///< vertices on the contour, and the same ones at the next key
};

/// Makes rings of discs, one for each part of a body, that follow its contour from key to key: it looks for good places, and whether the
/// discs hold a body between the keys is for CoverCheck.
///
/// The discs of the first key lie evenly on its contour. Each is expected where the nearest vertex of the contour takes it, and
/// match_in_order() finds its place on the next one. Where neighbours come farther apart than the spacing, because a part of the
/// body comes out from under another, more discs are put between them at all keys. Then the centres go behind the contour by the
/// inset, but where the body is narrow: discs that touch the contour from inside stand out little between their neighbours.
/// Errors:  throws std::length_error beyond 4096 discs.
AnimatedChunk rings_along(std::span<const std::vector<KeyContour>> parts, const AnimateOptions& options);

/// Returns the power of two that coordinates up to a reach are rounded to: each is it times a number of 16 bits.
double step_of(double reach);

}  // namespace bch::detail
