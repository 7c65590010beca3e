// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/outline/grid_geometry.hpp"

/// Declares the arguments of the loops in lanes.hpp: plain pointers, because no function of the standard library may
/// be compiled for wide registers.
namespace bch::detail {

struct Segment {
  GridPoint a, b;
};

/// Boxes are rectangles in cells of 2^9 grid steps, so that coordinates have 16 bits. Rounding down keeps order, so
/// boxes that meet on the grid also meet in cells.
constexpr int cell_bits = 9;

constexpr std::size_t boxes_per_block = 16;
struct alignas(64) BoxBlock {
  std::int16_t min_x[boxes_per_block], min_y[boxes_per_block];
  std::int16_t max_x[boxes_per_block], max_y[boxes_per_block];
};

/// Lists of triangles are padded to a multiple of this.
constexpr std::size_t triangles_together = 8;

/// Groups are searched this many at a time: the bits of their boxes fit a 64-bit word.
constexpr std::size_t groups_in_a_word = 4;

/// Holds two levels of boxes (SegmentBoxes), the candidates inside them, and memory for the result of a search.
struct SegmentSearch {
  const BoxBlock* blocks;  ///< around segments
  const BoxBlock* groups;  ///< around blocks; padded by empty ones to a multiple of groups_in_a_word
  std::size_t group_count;
  const Segment* segments;

  std::uint32_t* near;  ///< numbers of the candidates found; the other results are per candidate
  double *side_a, *side_b;
  double *along, *at;
  std::uint64_t *crossing, *ending;  ///< one bit per candidate
};

/// Describes a line from `from` to `to`, searched from its fraction `at` on; the box is around that part.
struct SearchedLine {
  std::int32_t from_x, from_y, to_x, to_y;
  double at;
  std::int16_t min_x, min_y, max_x, max_y;
};

/// Holds the functions of one compilation of lanes.hpp, which documents them.
struct OutlineLoops {
  void (*find_sides)(const std::uint32_t* corners, std::size_t count, const GridPoint* points,
                     std::uint8_t* sides) noexcept;
  std::size_t (*find_near)(const SegmentSearch& job, const SearchedLine& searched) noexcept;
  void (*test_near)(const SegmentSearch& job, const SearchedLine& searched, std::size_t count) noexcept;
};

}  // namespace bch::detail
