// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <bch/geometry.hpp>

namespace bch::report {

/// Returns whether the triangles enclose a volume: each edge is passed one way as often as the other.
bool is_closed(std::span<const std::array<std::uint32_t, 3>> triangles);

/// Returns the volume inside a closed mesh whose triangles run counter-clockwise seen from outside, cubic
/// metres. A region inside two parts of the mesh counts twice.
double enclosed_volume(std::span<const Vec3> positions,
                       std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace bch::report
