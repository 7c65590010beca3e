// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/outline/grid_geometry.hpp"

/// Declares what the outline's walk asks of an instruction set: plain pointers, because nothing of the
/// standard library may be compiled for wide registers.
namespace bch::detail {

struct Segment {
  GridPoint a, b;
};

/// Rectangles in cells of 2^9 grid steps, which fit 16 bits. Rounding down keeps order, so boxes that meet on
/// the grid meet here too.
constexpr int cell_bits = 9;

constexpr std::size_t boxes_per_block = 16;
struct alignas(64) BoxBlock {
  std::int16_t min_x[boxes_per_block], min_y[boxes_per_block];
  std::int16_t max_x[boxes_per_block], max_y[boxes_per_block];
};

/// Lists of triangles are filled up to a multiple of that.
constexpr std::size_t triangles_together = 8;

/// The most groups that are searched together: the bits of their boxes fit a word.
constexpr std::size_t groups_in_a_word = 4;

/// Holds two levels of boxes (SegmentBoxes), the candidates that they are around, and room for what is found.
struct SegmentSearch {
  const BoxBlock* blocks;  ///< around segments
  const BoxBlock* groups;  ///< around blocks; empty ones follow up to a multiple of groups_in_a_word
  std::size_t group_count;
  const Segment* segments;

  std::uint32_t* near;  ///< segments; for each the following
  double *side_a, *side_b;
  double *along, *at;
  std::uint64_t *crossing, *ending;  ///< a bit for each
};

/// Holds the rest of a line from the place at `at` of it; the box is around it.
struct SearchedLine {
  std::int32_t from_x, from_y, to_x, to_y;
  double at;
  std::int16_t min_x, min_y, max_x, max_y;
};

/// Represents one compilation of lanes.hpp, which says what the functions do.
struct OutlineLoops {
  void (*find_sides)(const std::uint32_t* corners, std::size_t count, const GridPoint* points,
                     std::uint8_t* sides) noexcept;
  std::size_t (*find_near)(const SegmentSearch& job, const SearchedLine& searched) noexcept;
  void (*test_near)(const SegmentSearch& job, const SearchedLine& searched, std::size_t count) noexcept;
};

}  // namespace bch::detail
