// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

// Private to the importer: faces of more than three corners.

namespace bch::detail::importing {

/// Appends the triangles of a face of three or more corners, which are numbers of finite vertices; two fewer than corners. A
/// simple polygon, seen along the main axis of its normal, is covered exactly and without overlap, and every corner on an edge
/// is a corner of a triangle there. Any other polygon is cut all the same: each of its corners is one of a triangle.
void append_triangles_of(std::span<const Vec3> vertices, std::span<const std::uint32_t> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace bch::detail::importing
