// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/leaf_segments.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// The relation of two segments.
enum class Meeting : std::uint8_t {
  none,
  near,  ///< they come within the margin of each other
  sure,  ///< also, the outlines surely cross: some leaves that hold the crossing overlap with all ancestors
};

/// Returns how near segments of two shapes are that meet, metres. (`Simd` keeps instruction sets from sharing a function.)
template <class Simd>
double segment_margin(const ShapeSetView& shapes, std::uint32_t shape_a, std::uint32_t shape_b) noexcept {
  const double of_a = shapes.segment_margin[shape_a], of_b = shapes.segment_margin[shape_b];
  return of_a + of_b;
}

/// Exact leaves: collects pairs of segments, one of either shape, and tests them side by side, lane = pair.
/// Every operation is one in double of a fixed sequence, which baselines/ writes down again;
/// layout/base/rounding.hpp, V, says why no two outlines that meet are missed.
/// `Placed`: has a Transform b_in_a and a double margin, which is that of both shapes together.
template <class Simd, class Placed>
class SegmentTest {
 public:
  /// `placed`: what add() names by index.
  SegmentTest(const ShapeSetView& shapes, const Placed* placed) noexcept
      : leaves_{shapes.leaf_segments}, points_(shapes.points), placed_(placed) {}

  /// Asks for the words of a leaf window, or for the points that they name.
  [[gnu::always_inline]] void prefetch_words(const Tree& tree, std::uint32_t window) const noexcept {
    __builtin_prefetch(leaves_.word(tree, window & ~leaf_window));
  }
  [[gnu::always_inline]] void prefetch_points(const Tree& tree, std::uint32_t window) const noexcept {
    const std::uint32_t* const words = leaves_.word(tree, window & ~leaf_window);
    const std::uint32_t last = tree.count < block_width ? tree.count - 1 : block_width - 1;
    const std::uint32_t asked[] = {0, last / 2, last};
    for (const std::uint32_t i : asked)
      __builtin_prefetch(points_ + tree.points + (words[i] & leaf_first_mask));
  }

  /// Collects all segments of a leaf of A with all of a leaf of B, named by the places of their discs among
  /// ShapeSetView::nodes. Tests those that were collected before where there is no room for more. Both trees
  /// have segments. `use(owner, meeting)` is called for each pair of segments that meets, now or in finish(),
  /// and for leaves of too many segments as if some met.
  template <class Use>
  [[gnu::always_inline]] void add(std::uint32_t placed, const Tree& a, std::uint32_t leaf_a, const Tree& b,
                                  std::uint32_t leaf_b, std::uint32_t owner, Use use) noexcept {
    const auto of_a = leaves_.segments(a, leaf_a), of_b = leaves_.segments(b, leaf_b);
    if (of_a.count * of_b.count == 0) [[unlikely]]
      return use(owner, Meeting::near);
    for (std::uint32_t i = 0; i < of_a.count; ++i)
      for (std::uint32_t j = 0; j < of_b.count; ++j) {
        if (size_ == capacity) [[unlikely]]
          finish(use);
        segment_a_[size_] = of_a.point(i), segment_b_[size_] = of_b.point(j);
        index_[size_] = placed;
        owner_[size_++] = owner;
      }
  }

  /// Tests all that were collected.
  template <class Use>
  [[gnu::noinline]] void finish(Use use) noexcept {
    for (std::uint32_t k = size_; k % Simd::width != 0; ++k)
      segment_a_[k] = segment_a_[size_ - 1], segment_b_[k] = segment_b_[size_ - 1],
      index_[k] = index_[size_ - 1];
    for (std::uint32_t k = 0; k < size_; k += Simd::width) {
      std::uint32_t open = test(k);
      if (size_ - k < Simd::width) open &= (std::uint32_t{1} << (size_ - k)) - 1;
      for (; open != 0; open &= open - 1) {
        const std::uint32_t lane = k + static_cast<unsigned>(__builtin_ctz(open));
        use(owner_[lane], meeting(k, lane));
      }
    }
    size_ = 0;
  }

 private:
  using Float = typename Simd::Float;
  using Double = typename Simd::Double;
  static constexpr std::uint32_t parts =
      Simd::width / Simd::doubles;  ///< registers of doubles for one of floats
  static constexpr std::uint32_t capacity = 64;
  static_assert(capacity % Simd::width == 0);
  static_assert(sizeof(Placed) % sizeof(double) == 0 && alignof(Placed) == alignof(double));

  using Point = PointIn<Double>;
  struct Pair {
    Point p0, p1, q0, q1;  ///< in A's frame
    Double margin;
  };

  /// Loads the pairs of a register of floats, in registers of doubles.
  void load(std::uint32_t k, Pair (&pairs)[parts]) const noexcept {
    Float p[4], q[4], place[4];
    Simd::template load_records<2>(&points_->x, segment_a_ + k, p);
    Simd::template load_records<2>(&points_->x, segment_b_ + k, q);
    Simd::template load_records<sizeof(Placed) / sizeof(float)>(&placed_->b_in_a.c, index_ + k, place);
    Double of_p[4][parts], of_q[4][parts], of_place[4][parts];
    for (unsigned i = 0; i < 4; ++i) {
      Simd::widened(p[i], of_p[i]);
      Simd::widened(q[i], of_q[i]);
      Simd::widened(place[i], of_place[i]);
    }
    for (std::uint32_t part = 0; part < parts; ++part) {
      const TransformOf<Double> b_in_a{of_place[0][part], of_place[1][part], of_place[2][part],
                                       of_place[3][part]};
      double margins[Simd::doubles];
      for (std::uint32_t lane = 0; lane < Simd::doubles; ++lane)
        margins[lane] = placed_[index_[k + part * Simd::doubles + lane]].margin;
      pairs[part] = {{of_p[0][part], of_p[1][part]},
                     {of_p[2][part], of_p[3][part]},
                     b_in_a.apply(of_q[0][part], of_q[1][part]),
                     b_in_a.apply(of_q[2][part], of_q[3][part]),
                     Simd::load(margins)};
    }
  }

  static Point way(Point from, Point to) noexcept { return {to.x - from.x, to.y - from.y}; }

  /// The sides of the line of one segment on which the ends of another lie.
  struct Sides {
    Double high, low;  ///< of both ends, the larger and the smaller
    Double margin;     ///< what counts at least as the margin's distance from the line
  };
  static Sides sides(Point from, Point to, Point first, Point second, Double margin) noexcept {
    const Point along = way(from, to), to_first = way(from, first), to_second = way(from, second);
    const Double of_first = along.x * to_first.y - along.y * to_first.x,
                 of_second = along.x * to_second.y - along.y * to_second.x;
    return {xsimd::max(of_first, of_second), xsimd::min(of_first, of_second),
            margin * (xsimd::abs(along.x) + xsimd::abs(along.y))};
  }

  /// Two numbers a pair, which say by being above 0 that a line separates the segments, and that they surely
  /// cross.
  /// Returns: bits of the pairs of which the first number may not be.
  std::uint32_t test(std::uint32_t k) noexcept {
    Pair pairs[parts];
    load(k, pairs);
    const Double zero(0.0), share(rounding::sure_share);
    const auto beside = [&](const Sides& of) { return xsimd::max(of.low, zero - of.high) - of.margin; };
    const auto across = [&](const Sides& of) {
      return xsimd::min(of.high, zero - of.low) - share * of.margin;
    };
    Double apart[parts];
    for (std::uint32_t part = 0; part < parts; ++part) {
      const auto& [p0, p1, q0, q1, margin] = pairs[part];
      const Sides of_p = sides(p0, p1, q0, q1, margin), of_q = sides(q0, q1, p0, p1, margin);
      apart[part] = xsimd::max(beside(of_p), beside(of_q));
      Simd::store(apart_ + k + part * Simd::doubles, apart[part]);
      Simd::store(sure_ + k + part * Simd::doubles, xsimd::min(across(of_p), across(of_q)));
    }
    return Simd::bits(Simd::rounded(apart) <= Float(0.0f));
  }

  Meeting meeting(std::uint32_t k, std::uint32_t lane) noexcept {
    if (apart_[lane] > 0) return Meeting::none;
    return sure_[lane] > 0 ? Meeting::sure : near(k, lane);
  }

  /// Returns whether the segments of a pair come within the margin. It computes the register of the pairs
  /// from k on for one of them, `lane`. About one in ten thousand pairs comes to this.
  [[gnu::noinline]] Meeting near(std::uint32_t k, std::uint32_t lane) noexcept {
    Pair pairs[parts];
    load(k, pairs);
    double beyond[Simd::width];
    for (std::uint32_t part = 0; part < parts; ++part) {
      const auto& [p0, p1, q0, q1, margin] = pairs[part];
      const Double nearest = xsimd::min(xsimd::min(square_distance(p0, q0, q1), square_distance(p1, q0, q1)),
                                        xsimd::min(square_distance(q0, p0, p1), square_distance(q1, p0, p1)));
      Simd::store(beyond + part * Simd::doubles, nearest - margin * margin);
    }
    return beyond[lane - k] <= 0 ? Meeting::near : Meeting::none;
  }

  /// Returns the square of the distance from a point to the nearest one of a segment.
  static Double square_distance(Point p, Point from, Point to) noexcept {
    const Point along = way(from, to), to_p = way(from, p);
    // A segment without length has a share of 0, by a number that is less than every other square.
    const Double square = xsimd::max(along.x * along.x + along.y * along.y, Double(1e-300));
    const Double share =
        xsimd::max(xsimd::min((to_p.x * along.x + to_p.y * along.y) / square, Double(1.0)), Double(0.0));
    const Double x = to_p.x - share * along.x, y = to_p.y - share * along.y;
    return x * x + y * y;
  }

  const LeafSegments<Simd> leaves_;
  const Vec2* const points_;
  const Placed* const placed_;
  std::uint32_t size_ = 0;
  std::uint32_t segment_a_[capacity], segment_b_[capacity];  ///< points where they begin
  std::uint32_t index_[capacity], owner_[capacity];
  double apart_[capacity], sure_[capacity];
};

}  // namespace bch::detail
