// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns the part that a shape has in a slab, or no_part. (Inlined for certain, so that instruction sets share no function.)
[[gnu::always_inline]] inline std::uint32_t part_of(const ShapeSetView& shapes, std::uint32_t shape,
                                                    std::uint32_t slab) noexcept {
  return shapes.slab_parts == nullptr ? shape
                                      : shapes.slab_parts[std::size_t{shape} * shapes.slab_count + slab];
}

/// Calls visit(part, slab) for each part of a shape once, with the lowest slab that has it.
template <class Visit>
void visit_parts(const ShapeSetView& shapes, std::uint32_t shape, const Visit& visit) {
  std::uint32_t last = no_part;
  for (std::uint32_t slab = 0; slab < shapes.slab_count; ++slab) {
    const std::uint32_t part = part_of(shapes, shape, slab);
    if (part != no_part && part != last) visit(last = part, slab);
  }
}

/// Returns how many discs a level of a part has.
inline std::uint32_t disc_count(const ShapeSetView& shapes, std::uint32_t part,
                                std::uint32_t level) noexcept {
  return shapes.trees == nullptr ? 1 : shapes.trees[std::size_t{part} * shapes.level_count + level].count;
}

/// Returns the first part of a shape; the others follow it.
inline std::uint32_t first_part(const ShapeSetView& shapes, std::uint32_t shape) noexcept {
  std::uint32_t slab = 0;
  while (part_of(shapes, shape, slab) == no_part) ++slab;
  return part_of(shapes, shape, slab);
}

/// Returns where the discs of a part begin among those of its shape's cut.
inline std::uint32_t first_disc(const ShapeSetView& shapes, std::uint32_t shape, std::uint32_t part,
                                std::uint32_t level) noexcept {
  std::uint32_t discs = 0;
  for (std::uint32_t before = first_part(shapes, shape); before < part; ++before)
    discs += disc_count(shapes, before, level);
  return discs;
}

}  // namespace bch::detail
