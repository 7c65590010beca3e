// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "kernel/simd/leaf_segments.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds two segments, lane = pair: p of A, and q of B, transformed into A's frame by floats. Operations are a fixed sequence. In
/// double, baselines/ repeats it, and layout/base/rounding.hpp, V, derives its error.
template <class Simd, class Real = typename Simd::Double>
struct SegmentPair {
  using Point = PointIn<Real>;

  Point p0, p1, q0, q1;

  /// Tells on which side of one segment's line the ends of the other lie.
  struct Sides {
    Real high, low;  ///< cross products of both ends, the larger and the smaller
    Real margin;     ///< the margin times the L1 length of the segment, at least its length

    /// Returns a value above 0 if both ends are on one side, farther than the margin.
    Real same_side() const noexcept { return xsimd::max(low, Real(0.0) - high) - margin; }
    /// Returns a value above 0 if the ends are surely on different sides.
    Real across() const noexcept {
      return xsimd::min(high, Real(0.0) - low) - Real(rounding::sure_fraction) * margin;
    }
  };
  Sides sides_of_p(Real margin) const noexcept { return sides(p0, p1, q0, q1, margin); }
  Sides sides_of_q(Real margin) const noexcept { return sides(q0, q1, p0, p1, margin); }

  /// Returns the square of the least distance of an end from the other segment.
  Real square_of_ends() const noexcept {
    return xsimd::min(xsimd::min(square_distance(p0, q0, q1), square_distance(p1, q0, q1)),
                      xsimd::min(square_distance(q0, p0, p1), square_distance(q1, p0, p1)));
  }

 private:
  /// Returns a number below the squared length of every segment that is not a point.
  static Real shortest_square() noexcept {
    if constexpr (std::is_same_v<Real, typename Simd::Double>)
      return Real(1e-300);
    else
      return Real(1e-37f);
  }

  static Point way(Point from, Point to) noexcept { return {to.x - from.x, to.y - from.y}; }

  static Sides sides(Point from, Point to, Point first, Point second, Real margin) noexcept {
    const Point along = way(from, to), to_first = way(from, first), to_second = way(from, second);
    const Real of_first = along.x * to_first.y - along.y * to_first.x,
               of_second = along.x * to_second.y - along.y * to_second.x;
    return {xsimd::max(of_first, of_second), xsimd::min(of_first, of_second),
            margin * (xsimd::abs(along.x) + xsimd::abs(along.y))};
  }

  /// Returns the square of the distance from a point to the nearest one of a segment.
  static Real square_distance(Point p, Point from, Point to) noexcept {
    const Point along = way(from, to), to_p = way(from, p);
    // A segment without length has a fraction of 0, by a number that is less than the square of any other length.
    const Real square = xsimd::max(along.x * along.x + along.y * along.y, shortest_square());
    const Real fraction =
        xsimd::max(xsimd::min((to_p.x * along.x + to_p.y * along.y) / square, Real(1.0)), Real(0.0));
    const Real x = to_p.x - fraction * along.x, y = to_p.y - fraction * along.y;
    return x * x + y * y;
  }
};

/// Holds the transform of a pair of agents, and the sum of their shapes' margins, metres; see rounding.hpp, V.
struct PlacedSegments {
  Transform b_in_a;
  double margin;
};

/// Collects pairs of segments, of a leaf of A and of a leaf of B, to test many side by side.
template <class Simd>
class SegmentBatch {
 public:
  /// `placed`: the array into which add() indexes.
  SegmentBatch(const ShapeSetView& shapes, const PlacedSegments* placed) noexcept
      : leaves_{shapes.leaf_segments}, points_(shapes.points), placed_(placed) {}

  using Row = typename LeafSegments<Simd>::Row;
  Row row(const Tree& tree, std::uint32_t leaf) const noexcept { return leaves_.row(tree, leaf); }

  /// Prefetches the words of eight leaves, or the points that they name.
  [[gnu::always_inline]] static void prefetch_words(const Row& row) noexcept {
    __builtin_prefetch(row.words + row.first);
  }
  [[gnu::always_inline]] void prefetch_points(const Row& row, std::uint32_t leaves) const noexcept {
    const std::uint32_t last = leaves < block_width ? leaves - 1 : block_width - 1;
    const std::uint32_t chosen[] = {0, last / 2, last};
    for (const std::uint32_t i : chosen)
      __builtin_prefetch(points_ + row.points + (row.word(i) & leaf_first_mask));
  }

 protected:
  using Float = typename Simd::Float;
  using Double = typename Simd::Double;
  static constexpr std::uint32_t parts =
      Simd::width / Simd::doubles;  ///< registers of doubles for one of floats
  static constexpr std::uint32_t capacity = 64;
  static_assert(capacity % Simd::width == 0);

  /// Collects all pairs of a segment of leaf i of row a and a segment of leaf j of row b; first calls finish() if there is no
  /// room. Both trees have segments. `placed`, and the caller's number `owner`, which owner() returns, are below 2^16.
  /// Returns: false if a leaf has too many segments, so that discs decide.
  template <class Finish>
  [[gnu::always_inline]] bool collect(std::uint32_t placed, const Row& a, std::uint32_t i, const Row& b,
                                      std::uint32_t j, std::uint32_t owner, Finish finish) noexcept {
    const std::uint32_t word_a = a.word(i), word_b = b.word(j);
    const std::uint32_t columns = word_b >> leaf_count_shift, count = (word_a >> leaf_count_shift) * columns;
    if (size_ + few > capacity) [[unlikely]]
      finish();
    // The most common case without a branch on the counts: what is written beyond `count` is overwritten later.
    if ((word_a | word_b) < leaf_list && count - 1 < few) [[likely]] {
      fill(segment_a_, quotients.of[columns - 1], a.points + (word_a & leaf_first_mask));
      fill(segment_b_, rests.of[columns - 1], b.points + (word_b & leaf_first_mask));
      fill(owner_, zeros, placed << 16 | owner);
      size_ += count;
      return true;
    }
    const auto of_a = a.segments(i), of_b = b.segments(j);
    for (std::uint32_t k = 0; k < of_a.count; ++k)
      for (std::uint32_t l = 0; l < of_b.count; ++l)
        append(placed, of_a.point(k), of_b.point(l), owner, finish);
    return of_a.count * of_b.count != 0;
  }
  /// Collects one pair of segments, named by the points where they begin.
  template <class Finish>
  [[gnu::always_inline]] void append(std::uint32_t placed, std::uint32_t a, std::uint32_t b,
                                     std::uint32_t owner, Finish finish) noexcept {
    if (size_ == capacity) [[unlikely]]
      finish();
    segment_a_[size_] = a, segment_b_[size_] = b;
    owner_[size_++] = placed << 16 | owner;
  }

  /// Calls test(k) for every register of pairs, and use(k, lane) for each bit that it returns.
  template <class Test, class Use>
  [[gnu::always_inline]] void test_all(Test test, Use use) noexcept {
    fill_register();
    visit(test, use);
    size_ = 0;
  }
  /// Repeats the last pair up to the end of its register.
  void fill_register() noexcept {
    for (std::uint32_t k = size_; k % Simd::width != 0; ++k)
      segment_a_[k] = segment_a_[size_ - 1], segment_b_[k] = segment_b_[size_ - 1],
      owner_[k] = owner_[size_ - 1];
  }
  /// Retains the pairs whose bits test(k) sets.
  template <class Test>
  [[gnu::always_inline]] void retain(Test test) noexcept {
    std::uint32_t retained = 0;
    visit(test, [&](std::uint32_t k, unsigned lane) {
      segment_a_[retained] = segment_a_[k + lane], segment_b_[retained] = segment_b_[k + lane];
      owner_[retained++] = owner_[k + lane];
    });
    size_ = retained;
  }

  std::uint32_t size() const noexcept { return size_; }
  /// Return the owner of pair k, and the points at which its segments begin.
  std::uint32_t owner(std::uint32_t k) const noexcept { return owner_[k] & 0xffff; }
  std::uint32_t segment_a(std::uint32_t k) const noexcept { return segment_a_[k]; }
  std::uint32_t segment_b(std::uint32_t k) const noexcept { return segment_b_[k]; }

  struct Pair : SegmentPair<Simd> {
    Double margin;
  };
  /// Loads the pairs of a register of floats, in registers of doubles.
  void load(std::uint32_t k, Pair (&pairs)[parts]) const noexcept {
    Float p[4], q[4], place[4];
    static_assert(sizeof(PlacedSegments) == 3 * sizeof(double));
    alignas(64) std::uint32_t index[Simd::width], margin_index[Simd::width];
    for (std::uint32_t lane = 0; lane < Simd::width; ++lane) {
      index[lane] = owner_[k + lane] >> 16;
      margin_index[lane] = 3 * index[lane];
    }
    Simd::template load_records<2>(&points_->x, segment_a_ + k, p);
    Simd::template load_records<2>(&points_->x, segment_b_ + k, q);
    Simd::template load_records<sizeof(PlacedSegments) / sizeof(float)>(&placed_->b_in_a.c, index, place);
    Double of_p[4][parts], of_q[4][parts], of_place[4][parts];
    for (unsigned i = 0; i < 4; ++i) {
      Simd::to_double(p[i], of_p[i]);
      Simd::to_double(q[i], of_q[i]);
      Simd::to_double(place[i], of_place[i]);
    }
    for (std::uint32_t part = 0; part < parts; ++part) {
      const TransformOf<Double> b_in_a{of_place[0][part], of_place[1][part], of_place[2][part],
                                       of_place[3][part]};
      pairs[part] = {{{of_p[0][part], of_p[1][part]},
                      {of_p[2][part], of_p[3][part]},
                      b_in_a.apply(of_q[0][part], of_q[1][part]),
                      b_in_a.apply(of_q[2][part], of_q[3][part])},
                     Simd::gather(&placed_->margin, margin_index + part * Simd::doubles)};
    }
  }
  /// Loads the pairs of a register, all with one placement, in floats.
  SegmentPair<Simd, Float> load(std::uint32_t k, const TransformOf<Float>& b_in_a) const noexcept {
    Float p[4], q[4];
    Simd::template load_records<2>(&points_->x, segment_a_ + k, p);
    Simd::template load_records<2>(&points_->x, segment_b_ + k, q);
    return {{p[0], p[1]}, {p[2], p[3]}, b_in_a.apply(q[0], q[1]), b_in_a.apply(q[2], q[3])};
  }

 private:
  template <class Test, class Use>
  [[gnu::always_inline]] void visit(Test test, Use use) noexcept {
    for (std::uint32_t k = 0; k < size_; k += Simd::width) {
      std::uint32_t open = test(k);
      if (size_ - k < Simd::width) open &= (std::uint32_t{1} << (size_ - k)) - 1;
      for (; open != 0; open &= open - 1) use(k, static_cast<unsigned>(__builtin_ctz(open)));
    }
  }

  /// Two leaves with at most this many pairs of segments are collected without a loop. Most leaves have one or two
  /// segments.
  static constexpr std::uint32_t few = 4;
  /// Holds two numbers of 32 bits each, which are added at once.
  using Two = std::uint64_t;
  struct Pattern {
    Two of[few][few / 2];
  };
  /// Returns k / columns, or k % columns, for every pair k of two leaves, of which the second has `columns` segments.
  static constexpr Pattern pattern(bool rest) {
    Pattern result{};
    for (std::uint32_t columns = 1; columns <= few; ++columns)
      for (std::uint32_t k = 0; k < few; ++k)
        result.of[columns - 1][k / 2] |= Two{rest ? k % columns : k / columns} << (k % 2 * 32);
    return result;
  }
  static constexpr Pattern quotients = pattern(false), rests = pattern(true);
  static constexpr Two zeros[few / 2] = {};

  /// Writes the `few` numbers of a pattern, each plus `number`. (The halves of a word are in the order of memory only on
  /// little-endian processors.)
  [[gnu::always_inline]] void fill(std::uint32_t* to, const Two* pattern,
                                   std::uint32_t number) const noexcept {
    static_assert(std::endian::native == std::endian::little);
    const Two twice = number * Two{0x1'0000'0001};
    for (std::uint32_t k = 0; k < few / 2; ++k) {
      const Two sum = pattern[k] + twice;
      __builtin_memcpy(to + size_ + 2 * k, &sum, sizeof sum);
    }
  }

  const LeafSegments<Simd> leaves_;
  const Vec2* const points_;
  const PlacedSegments* const placed_;
  std::uint32_t size_ = 0;
  std::uint32_t segment_a_[capacity], segment_b_[capacity];
  std::uint32_t owner_[capacity];
};

}  // namespace bch::detail
