// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

/// Represents a square of the ground, by its place in rows and columns.
struct Cell {
  std::int32_t x, y;
  friend bool operator==(Cell, Cell) = default;
};

/// Returns the square of this side that holds a point. Larger coordinates have no smaller columns and rows, however they are rounded.
/// Precondition: |x|, |y| below 2^30 sides.
Cell cell_at(double x, double y, double side);

/// Returns a square's place on a Hilbert curve through the whole plane: squares that follow each other share a side.
std::uint64_t curve_key(Cell cell);

}  // namespace bch::detail
