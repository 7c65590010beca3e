// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/enclosure.hpp"

#include <limits>

#include "layout/enclosing_disc.hpp"

namespace bch {

Enclosure enclosure(const Outline& outline, double reach) {
  // Centres a and b in float arithmetic are off by 12 u (P_A + P_B) together, so |a - b|^2 by 7.2e-7 (P_A^2 + 3 P_B^2)
  // where A lies inside B and |a - b| <= R <= P_B; discs and the comparison add less than 1e-6 P^2 each.
  const double slack = 1e-5 * reach * reach;
  const EnclosingDisc disc = smallest_enclosing_disc(outline.points);
  const double square = disc.radius * disc.radius;
  return {.x = disc.centre.x,
          .y = disc.centre.y,
          .outer_square = static_cast<float>(square + slack),
          .inner_square = outline.contours() == 1 ? static_cast<float>(square - slack)
                                                  : -std::numeric_limits<float>::infinity()};
}

}  // namespace bch
