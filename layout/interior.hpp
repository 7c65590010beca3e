// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>

#include "layout/outline.hpp"
#include "layout/shape_set_view.hpp"

namespace bch {

/// What lets a query accept a pair without walking its trees. All of it belongs to the outline's largest
/// contour.
///
/// Where a disc inside one contour overlaps a disc inside another, the contours' areas meet. Then either the
/// contours cross, which both semantics call a hit at every level, or one lies inside the other, which solid
/// calls a hit too. Boundary may accept only where nesting is excluded: when each contour has a point beyond
/// the other's supports (supports.hpp).
struct Interior {
  /// Discs inside the contour, their radii rounded inward by what rounding.hpp derives; padded like a block.
  std::array<float, block_width> x, y, radius;
  /// The contour's farthest point along each direction of the supports, twice over, as supports are stored.
  std::array<float, extreme_stride> extreme_x, extreme_y;
};

/// Inscribed discs are chosen one after the other, each to add the most area to the union of the discs chosen
/// so far, all of them dilated by a quarter of the enclosing radius: what matters is not to fill the contour
/// but to be near anything that may come in (72 % of colliding pairs are accepted without the dilation, 83 %
/// with it, by the prototype's measurement).
/// Preconditions: validate(outline) does not throw. `reach` is that of the shape, metres.
Interior interior(const Outline& outline, double reach);

}  // namespace bch
