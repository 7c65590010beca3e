// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <bch/geometry.hpp>

namespace bch::bench {

/// Tells whether the build found libpolyclipping.
extern const bool has_clipper;

/// Returns the area of the union of a pose's triangles, seen from above and rounded to steps of a grid, by
/// libpolyclipping.
/// Units:   metres.
double clipper_union_area(std::span<const Vec2> positions,
                          std::span<const std::array<std::uint32_t, 3>> triangles, double step);

}  // namespace bch::bench
