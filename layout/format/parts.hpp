// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// The part that a shape has in a slab, or no_part. (Inlined for certain, so that instruction sets share no function.)
[[gnu::always_inline]] inline std::uint32_t part_of(const ShapeSetView& shapes, std::uint32_t shape,
                                                    std::uint32_t slab) noexcept {
  return shapes.slab_parts == nullptr ? shape
                                      : shapes.slab_parts[std::size_t{shape} * shapes.slab_count + slab];
}

}  // namespace bch::detail
