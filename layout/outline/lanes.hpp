// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/outline/segment_search.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Implements the two loops that take most of the time of an outline, several triangles or segments per register.
/// Everything that decides an outline is exact (grid_geometry.hpp) and the quotient is correctly rounded, so every
/// instruction set gives the same bits.
template <class Simd>
class OutlineLanes {
 public:
  /// Finds the orientation of triangles: bit 0 for counter-clockwise, bit 1 for clockwise, neither for corners on a
  /// line or too close to one to tell. `count` is a multiple of triangles_together. The orientation is the sign of a
  /// difference of two products. Float represents their factors exactly, and rounding a product keeps order: if the
  /// rounded products differ, so do the exact ones, in the same order. Exact products would take as long, because
  /// loads dominate.
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

  /// Finds the candidates whose boxes meet the box of the searched line, and tests them.
  /// Returns: the number of these candidates.
  static std::size_t find_near(const SegmentSearch& job, const SearchedLine& searched) noexcept {
    const std::size_t count = find_meeting(job, searched);
    test_near(job, searched, count);
    return count;
  }

  /// Tests the first `count` candidates of job.near against the searched line. A bit of job.crossing says that the
  /// candidate crosses it from left to right, before its end and not before searched.at (as far as doubles tell); a
  /// bit of job.ending says that the candidate touches its end. With O the start of the searched line, D its
  /// direction and (a, b) the candidate: side_a = D x (a - O), side_b = D x (b - O). The fraction of the searched
  /// line at the crossing has the magnitude of side_a - side_b as denominator; job.along is the numerator, job.at the
  /// quotient. Candidates that fill up a register follow those in job.near.
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

    /// Returns a bit for each box of a block that this box meets.
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

  /// Writes the segments whose boxes meet the box of the searched line, padded by zeros to a whole register:
  /// additional or repeated candidates do no harm.
  /// Returns: the number of segments without padding.
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

  /// Appends the numbers, counted from `first`, of the boxes of a block whose bits are set. Their count is hard to
  /// predict, so a few numbers are always written; surplus ones are overwritten by the next call.
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
