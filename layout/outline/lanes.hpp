// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/outline/segment_search.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Implements the two loops of an outline that take most of its time, several triangles or segments a register.
/// What an outline is made of is exact (grid_geometry.hpp), so that every instruction set gives the same bits; the
/// quotient is rounded correctly on each.
template <class Simd>
class OutlineLanes {
 public:
  /// Finds which way the corners of triangles go round: bit 0 for counter-clockwise, bit 1 for clockwise, none where
  /// they are on a line, or so close to one that it is left open. `count` is a multiple of triangles_together.
  /// A turn's two terms are products of differences, which floats hold, rounded to floats. Rounding keeps order, so the
  /// larger one is; where they are then equal, it is left open. Exact products take as long, because the loads decide.
  static void find_sides(const std::uint32_t* corners, std::size_t count, const GridPoint* points,
                         std::uint8_t* sides) noexcept {
    static_assert(triangles_together % Simd::width == 0);
    for (std::size_t t = 0; t < count; t += Simd::width) {
      const auto corner = [&](std::size_t k, Ints& x, Ints& y) {
        Floats bits_x, bits_y;
        Simd::load_pairs([=](std::size_t i) { return points + corners[3 * (t + i) + k]; }, bits_x, bits_y);
        x = xsimd::bitwise_cast<Ints>(bits_x), y = xsimd::bitwise_cast<Ints>(bits_y);
      };
      Ints ax, ay, bx, by, cx, cy;
      corner(0, ax, ay), corner(1, bx, by), corner(2, cx, cy);
      const Floats plus = xsimd::to_float(bx - ax) * xsimd::to_float(cy - ay),
                   minus = xsimd::to_float(by - ay) * xsimd::to_float(cx - ax);
      const std::uint32_t left = Simd::bits(minus < plus), right = Simd::bits(plus < minus);
      // Four bits spread to the lowest bits of four bytes.
      constexpr std::uint32_t spread = 0x00204081, lowest = 0x01010101;
      for (std::size_t i = 0; i < Simd::width; i += 4) {
        const std::uint32_t four =
            ((left >> i & 15) * spread & lowest) | ((right >> i & 15) * spread & lowest) << 1;
        __builtin_memcpy(sides + t + i, &four, sizeof four);
      }
    }
  }

  /// Finds the candidates whose boxes meet that of the searched line, and tests them.
  /// Returns: how many are near.
  static std::size_t find_near(const SegmentSearch& job, const SearchedLine& searched) noexcept {
    const std::size_t count = find_meeting(job, searched);
    test_near(job, searched, count);
    return count;
  }

  /// Says of each of `count` candidates that stand in job.near whether its line crosses the searched line from left to right further on than searched.at (or equally far, as far as doubles tell) and before its end,
  /// and whether it touches its end. With O the start of the searched line, D its direction and (a, b) the candidate:
  /// side_a = D x (a - O), side_b = D x (b - O); their difference is the denominator, `along` the numerator
  /// and `at` the quotient of where on it the candidate is crossed. Numbers that fill a register follow those in job.near.
  static void test_near(const SegmentSearch& job, const SearchedLine& searched, std::size_t count) noexcept {
    const Line line(searched);
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

  static constexpr OutlineLoops loops{find_sides, find_near, test_near};

 private:
  using Floats = typename Simd::Float;
  using Doubles = typename Simd::Double;
  using Ints = typename Simd::Ints;
  using Cells = typename Simd::template Batch<std::int16_t>;
  static constexpr std::size_t width = Simd::doubles;

  struct Found {
    std::uint64_t crossing, ending;
  };

  /// Holds the box of the searched line in every lane.
  struct Box {
    Cells min_x, min_y, max_x, max_y;

    explicit Box(const SearchedLine& searched) noexcept
        : min_x(searched.min_x), min_y(searched.min_y), max_x(searched.max_x), max_y(searched.max_y) {}

    /// Returns the bits of a block's boxes that it meets.
    std::uint32_t meets(const BoxBlock& block) const noexcept {
      std::uint32_t apart = 0;
      for (std::size_t i = 0; i < boxes_per_block; i += Cells::size)
        apart |= Simd::bits((Cells::load_aligned(block.min_x + i) > max_x) |
                            (Cells::load_aligned(block.min_y + i) > max_y) |
                            (min_x > Cells::load_aligned(block.max_x + i)) |
                            (min_y > Cells::load_aligned(block.max_y + i)))
                 << i;
      return apart ^ 0xffff;
    }
  };

  /// Writes the segments whose boxes meet that of the searched line, and zeros to fill a register: one candidate more, or
  /// one twice, does no harm.
  /// Returns: how many.
  static std::size_t find_meeting(const SegmentSearch& job, const SearchedLine& searched) noexcept {
    const Box box(searched);
    std::uint32_t* end = job.near;
    for (std::size_t group = 0; group < job.group_count; group += groups_in_a_word) {
      std::uint64_t open = 0;
      for (std::size_t i = 0; i < groups_in_a_word; ++i)
        open |= std::uint64_t{box.meets(job.groups[group + i])} << boxes_per_block * i;
      const BoxBlock* blocks = job.blocks + boxes_per_block * group;
      for (; open != 0; open &= open - 1) {
        const auto block = static_cast<std::size_t>(__builtin_ctzll(open));
        end = append(box.meets(blocks[block]), boxes_per_block * (boxes_per_block * group + block), end);
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
    const std::size_t count = Simd::count(open);
    std::uint64_t left = open | none;
    const auto take = [&] {
      const auto bit = static_cast<std::size_t>(__builtin_ctzll(left | none));
      left &= left - 1;
      return static_cast<std::uint32_t>(first + bit);
    };
    for (std::size_t i = 0; i < written_in_any_case; ++i) end[i] = take();
    for (std::size_t i = written_in_any_case; i < count; ++i) end[i] = take();
    return end + count;
  }

  /// Holds the searched line in every lane.
  struct Line {
    Doubles from_x, from_y, to_x, to_y, direction_x, direction_y, at;

    explicit Line(const SearchedLine& searched) noexcept
        : from_x(searched.from_x),
          from_y(searched.from_y),
          to_x(searched.to_x),
          to_y(searched.to_y),
          direction_x(to_x - from_x),
          direction_y(to_y - from_y),
          at(searched.at) {}

    Found test(const SegmentSearch& job, std::size_t i) const noexcept {
      static_assert(sizeof(Segment) == 4 * sizeof(std::int32_t));
      Doubles end[4];
      Simd::template load_integers<4>(&job.segments->a.x, job.near + i, end);
      const Doubles zero(0.0), ax = end[0] - from_x, ay = end[1] - from_y, bx = end[2] - from_x,
                               by = end[3] - from_y;
      const Doubles side_a = direction_x * ay - direction_y * ax,
                    side_b = direction_x * by - direction_y * bx;
      const auto a_right = side_a < zero, b_right = side_b < zero;
      const Doubles turn = bx * ay - by * ax, difference = side_a - side_b;
      const Doubles along = xsimd::select(a_right, -turn, turn),
                    whole = xsimd::select(a_right, -difference, difference);
      const Doubles quotient = along / whole;
      const auto crossing = (a_right ^ b_right) & (along > zero) & (along < whole) & (quotient >= at);
      Simd::store(job.side_a + i, side_a);
      Simd::store(job.side_b + i, side_b);
      Simd::store(job.along + i, along);
      Simd::store(job.at + i, quotient);

      const Doubles cx = end[0] - to_x, cy = end[1] - to_y, dx = end[2] - to_x, dy = end[3] - to_y;
      const auto ending = (cx * dy == cy * dx) & (cx * dx + cy * dy <= zero);
      return {Simd::bits(crossing), Simd::bits(ending)};
    }
  };
};

}  // namespace bch::detail
