// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/leaf_segments.hpp"
#include "kernel/simd/segment_pairs.hpp"
#include "kernel/simd/transform.hpp"
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
  using Ends = SegmentEnds<Simd>;
  static constexpr std::uint32_t parts = Ends::parts;
  static constexpr std::uint32_t capacity = 64;
  static_assert(capacity % Simd::width == 0);
  static_assert(sizeof(Placed) % sizeof(double) == 0 && alignof(Placed) == alignof(double));

  struct MarginPair : SegmentPair<Simd> {
    Double margin;
  };

  /// Loads the pairs of a register of floats, in registers of doubles.
  void load(std::uint32_t k, MarginPair (&pairs)[parts]) const noexcept {
    const Ends p = Ends::load(points_, segment_a_ + k), q = Ends::load(points_, segment_b_ + k);
    Float place[4];
    Simd::template load_records<sizeof(Placed) / sizeof(float)>(&placed_->b_in_a.c, index_ + k, place);
    Double of_place[4][parts];
    for (unsigned i = 0; i < 4; ++i) Simd::widened(place[i], of_place[i]);
    for (std::uint32_t part = 0; part < parts; ++part) {
      const TransformOf<Double> b_in_a{of_place[0][part], of_place[1][part], of_place[2][part],
                                       of_place[3][part]};
      double margins[Simd::doubles];
      for (std::uint32_t lane = 0; lane < Simd::doubles; ++lane)
        margins[lane] = placed_[index_[k + part * Simd::doubles + lane]].margin;
      pairs[part] = {Ends::pair(p, q, b_in_a, part), Simd::load(margins)};
    }
  }

  /// Two numbers a pair, which say by being above 0 that a line separates the segments, and that they surely
  /// cross.
  /// Returns: bits of the pairs of which the first number may not be.
  std::uint32_t test(std::uint32_t k) noexcept {
    MarginPair pairs[parts];
    load(k, pairs);
    Double apart[parts];
    for (std::uint32_t part = 0; part < parts; ++part) {
      const auto of_p = pairs[part].sides_of_p(pairs[part].margin),
                 of_q = pairs[part].sides_of_q(pairs[part].margin);
      apart[part] = xsimd::max(of_p.beside(), of_q.beside());
      Simd::store(apart_ + k + part * Simd::doubles, apart[part]);
      Simd::store(sure_ + k + part * Simd::doubles, xsimd::min(of_p.across(), of_q.across()));
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
    MarginPair pairs[parts];
    load(k, pairs);
    double beyond[Simd::width];
    for (std::uint32_t part = 0; part < parts; ++part) {
      const Double margin = pairs[part].margin;
      Simd::store(beyond + part * Simd::doubles, pairs[part].square_of_ends() - margin * margin);
    }
    return beyond[lane - k] <= 0 ? Meeting::near : Meeting::none;
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
