// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/shape_set.hpp>

#include "layout/hierarchy/discs.hpp"

namespace bch {

Shape shape_from_discs(std::span<const Disc> discs) {
  // In braces after an outline, GCC 12 destroys the outline twice where this throws.
  Shape shape;
  shape.hierarchy = detail::disc_hierarchy(discs);
  return shape;
}

}  // namespace bch
