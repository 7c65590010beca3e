// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/outline.hpp>

namespace bch::detail {

using TriangleList = std::vector<std::array<std::uint32_t, 3>>;

/// Represents a body's vertices at the time of a key.
struct KeyPose {
  float seconds = 0;
  std::vector<Vec2> vertices;
};

/// Divides triangles into parts that are apart at a key: two triangles are in one part if at every key the same contour goes round both.
/// So parts are the same at all keys, whatever contours do: those of feet that pass each other are one for a while, and feet still two parts.
/// A triangle that is a point at some key belongs to no part.
/// `outlines`: of the triangles, at each key. Returns: none where all triangles are one part.
std::vector<TriangleList> parts_apart(const TriangleList& triangles, std::span<const KeyPose> keys,
                                      std::span<const Outline> outlines);

}  // namespace bch::detail
