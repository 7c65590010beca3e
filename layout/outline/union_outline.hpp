// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "layout/base/disc.hpp"
#include "layout/format/outline.hpp"

namespace bch {

/// The outline of triangles that are seen once. OutlineBuilder says what an outline is, and finds those of one
/// mesh in many poses much faster.
/// Shapes:  triangle indices are below positions.size(); vertices that no triangle uses do not count.
/// Errors:  throws std::invalid_argument on no triangles, an index out of range, a coordinate that is not
///          finite, or a reach outside the domain of rounding.hpp.
Outline union_outline(std::span<const Vec3> positions,
                      std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace bch
