// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

struct IntegerPoint {
  std::int64_t x, y;
  friend bool operator==(const IntegerPoint&, const IntegerPoint&) = default;
};
using IntegerTriangle = std::array<IntegerPoint, 3>;
using IntegerContour = std::vector<IntegerPoint>;

/// Computes the outline that OutlineBuilder promises, from the definition and in cubic time. All edges of all
/// triangles are cut at each other, in exact fractions, and the contours are the boundaries of the
/// arrangement's unbounded face. (A triangle's edges bound it, so this face is that of the triangles' union.)
/// Coordinates are at most 2^23.
std::vector<IntegerContour> arrangement_outline(const std::vector<IntegerTriangle>& triangles);

}  // namespace bch::test
