// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/outline/segment_search.hpp"

namespace bch::detail {

/// The two loops of an outline that take most of its time, several triangles or segments a register.
/// What an outline is made of is exact (grid_geometry.hpp), so that every instruction set gives the same bits; the
/// quotient is rounded correctly on each. `Registers` is a type of the including file alone, so that no other file can
/// share what was compiled for its registers.
template <class Registers>
class OutlineLanes {
 public:
  /// Which way the corners of triangles go round: bit 0 for counter-clockwise, bit 1 for clockwise, none where
  /// they are on a line, or so close to one that it is left open. `count` is a multiple of four.
  static void find_sides(const std::uint32_t* corners, std::size_t count, const GridPoint* points,
                         std::uint8_t* sides) noexcept {
    for (std::size_t t = 0; t < count; t += 4) {
      const std::uint32_t four = Registers::sides_of_four(corners + 3 * t, points);
      __builtin_memcpy(sides + t, &four, sizeof four);
    }
  }

  /// Finds the candidates whose boxes meet that of the way, and tests them.
  /// Returns: how many are near.
  static std::size_t find_near(const SegmentSearch& job, const SearchedWay& way) noexcept {
    const std::size_t count = find_meeting(job, way);
    test_near(job, way, count);
    return count;
  }

  /// Says of each of `count` candidates that stand in job.near whether its line crosses the way's from left to right further on than way.at (or equally far, as far as doubles tell) and before its end,
  /// and whether it touches its end. With O the start of the way, D its direction and (a, b) the candidate:
  /// side_a = D x (a - O), side_b = D x (b - O); their difference is the denominator, `along` the numerator
  /// and `at` the quotient of where on the way it is crossed. Numbers that fill a register follow those in job.near.
  static void test_near(const SegmentSearch& job, const SearchedWay& way, std::size_t count) noexcept {
    const Line line(way);
    for (std::size_t word = 0, i = 0; i < count; ++word) {
      std::uint64_t crossing = 0, ending = 0;
      const std::size_t begin = i, end = begin + 64 < count ? begin + 64 : count;
      for (; i < end; i += width) {
        const Found found = line.test(job, i);
        crossing |= found.crossing << (i - begin);
        ending |= found.ending << (i - begin);
      }
      job.crossing[word] = crossing;
      job.ending[word] = ending;
    }
  }

 private:
  using Doubles = typename Registers::Doubles;
  using Cells = typename Registers::Cells;
  static constexpr std::size_t width = Registers::width;
  static constexpr std::size_t bits_per_box = Registers::bits_per_box;
  static constexpr std::size_t bits_per_block = bits_per_box * boxes_per_block;
  static constexpr std::size_t groups_together = 64 / bits_per_block;

  struct Found {
    std::uint64_t crossing, ending;
  };

  /// Writes the segments whose boxes meet that of the way, and zeros to fill a register: one candidate more, or
  /// one twice, does no harm.
  /// Returns: how many.
  static std::size_t find_meeting(const SegmentSearch& job, const SearchedWay& way) noexcept {
    const Cells box(way);
    std::uint32_t* end = job.near;
    for (std::size_t group = 0; group < job.group_count; group += groups_together) {
      std::uint64_t open = 0;
      for (std::size_t i = 0; i < groups_together; ++i)
        open |= std::uint64_t{Registers::meeting(job.groups[group + i], box)} << bits_per_block * i;
      const BoxBlock* blocks = job.blocks + boxes_per_block * group;
      for (; open != 0; open &= open - 1) {
        const std::size_t block = static_cast<std::size_t>(__builtin_ctzll(open)) / bits_per_box;
        end = append(Registers::meeting(blocks[block], box),
                     boxes_per_block * (boxes_per_block * group + block), end);
      }
    }
    for (std::size_t i = 0; i < width; ++i) end[i] = 0;
    return static_cast<std::size_t>(end - job.near);
  }

  /// Appends the numbers of a block's boxes whose bits are set, counted from `first`. How many there are is
  /// hard to predict, so a few are written in any case; what is not a number is overwritten by the next.
  static std::uint32_t* append(std::uint32_t open, std::size_t first, std::uint32_t* end) noexcept {
    constexpr std::size_t written_in_any_case = 3;
    constexpr std::uint64_t none = std::uint64_t{1} << 63;
    const std::size_t count = Registers::boxes(open);
    std::uint64_t left = open | none;
    const auto take = [&] {
      const auto bit = static_cast<std::size_t>(__builtin_ctzll(left | none));
      left &= left - 1;
      return static_cast<std::uint32_t>(first + bit / bits_per_box);
    };
    for (std::size_t i = 0; i < written_in_any_case; ++i) end[i] = take();
    for (std::size_t i = written_in_any_case; i < count; ++i) end[i] = take();
    return end + count;
  }

  /// The way in every lane.
  struct Line {
    Doubles from_x, from_y, to_x, to_y, way_x, way_y, at;

    explicit Line(const SearchedWay& way) noexcept
        : from_x(Registers::all(way.from_x)),
          from_y(Registers::all(way.from_y)),
          to_x(Registers::all(way.to_x)),
          to_y(Registers::all(way.to_y)),
          way_x(to_x - from_x),
          way_y(to_y - from_y),
          at(Registers::all(way.at)) {}

    Found test(const SegmentSearch& job, std::size_t i) const noexcept {
      const auto ends = Registers::load(job.segments, job.near + i);
      const Doubles ax = ends.ax - from_x, ay = ends.ay - from_y, bx = ends.bx - from_x,
                    by = ends.by - from_y;
      const Doubles side_a = way_x * ay - way_y * ax, side_b = way_x * by - way_y * bx;
      const auto a_right = side_a < 0, b_right = side_b < 0;
      const Doubles turn = bx * ay - by * ax, difference = side_a - side_b;
      const Doubles along = a_right ? -turn : turn, whole = a_right ? -difference : difference;
      const Doubles quotient = along / whole;
      const auto crossing = (a_right ^ b_right) & (along > 0) & (along < whole) & (quotient >= at);
      Registers::store(job.side_a + i, side_a);
      Registers::store(job.side_b + i, side_b);
      Registers::store(job.along + i, along);
      Registers::store(job.at + i, quotient);

      const Doubles cx = ends.ax - to_x, cy = ends.ay - to_y, dx = ends.bx - to_x, dy = ends.by - to_y;
      const auto ending = (cx * dy == cy * dx) & (cx * dx + cy * dy <= 0);
      return {Registers::bits_of(crossing), Registers::bits_of(ending)};
    }
  };
};

}  // namespace bch::detail
