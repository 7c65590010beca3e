// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/aligned_vector.hpp"
#include "layout/grid_geometry.hpp"

namespace bch {

struct Segment {
  GridPoint a, b;
};

/// A rectangle in cells of 2^9 grid steps, which fit 16 bits. Rounding down keeps order, so boxes that meet on
/// the grid meet here too.
struct CoarseBox {
  std::int16_t min_x, min_y, max_x, max_y;

  CoarseBox(std::int16_t x0, std::int16_t y0, std::int16_t x1, std::int16_t y1)
      : min_x(x0), min_y(y0), max_x(x1), max_y(y1) {}
  CoarseBox(GridPoint low, GridPoint high)
      : min_x(cell(low.x)), min_y(cell(low.y)), max_x(cell(high.x)), max_y(cell(high.y)) {}

 private:
  static std::int16_t cell(std::int32_t steps) { return static_cast<std::int16_t>(steps >> 9); }
};

/// Boxes around segments, 16 to a block, and around blocks, 16 to a block again, until few blocks are left.
/// The order of the segments makes the blocks: neighbours should be near each other.
class BoxTree {
 public:
  static constexpr std::size_t width = 16;

  /// Room for that many segments, so that assign() allocates nothing.
  void reserve(std::size_t segments);
  void assign(std::span<const Segment> segments);

  /// Writes the indices of all segments whose boxes meet the box, and of some whose boxes are near, in order.
  /// Returns: how many. `found` has room for all segments and one block more.
  std::size_t find_meeting(const CoarseBox& box, std::uint32_t* found);

 private:
  static constexpr std::size_t top_blocks = 8;

  /// Eight coordinates. A loop over plain arrays is vectorised or not by the compiler's whim, which doubles the
  /// time of a walk; GCC's and Clang's vector types are, in any target's baseline.
  using Lanes [[gnu::vector_size(16)]] = std::int16_t;

  /// The boxes of even and of odd number, half by half.
  struct alignas(64) Block {
    Lanes min_x[2], min_y[2], max_x[2], max_y[2];

    void set(std::size_t number, const CoarseBox& box) {
      const std::size_t half = number % 2, lane = number / 2;
      min_x[half][lane] = box.min_x, min_y[half][lane] = box.min_y;
      max_x[half][lane] = box.max_x, max_y[half][lane] = box.max_y;
    }
    CoarseBox around() const;
  };

  void lay_out(std::size_t segments);
  void pad(std::size_t count, std::size_t first_block);
  static std::uint32_t* append_meeting(const Block& block, const CoarseBox& box, std::uint32_t first,
                                       std::uint32_t* found);

  AlignedVector<Block> blocks_;
  std::vector<std::size_t> level_begin_;  ///< first block of each level, segments' own first; and the end
  std::vector<std::uint32_t> open_;       ///< blocks that meet the box asked for, of a level and the next
};

}  // namespace bch
