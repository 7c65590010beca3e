// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/distance/clearance_terms.hpp"
#include "kernel/simd/leaf_segments.hpp"
#include "kernel/simd/segment_pairs.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// The trees of two agents that both have segments, and the margin of both shapes, metres; see rounding.hpp, V.
struct SegmentedPair {
  const Tree *a, *b;
  double margin;
};

/// Exact leaves of clearance(): the gaps between segments that leaves hold, lane = pair of segments. In double, with B's ends as the
/// floats of the placement put them:
///
///     w = max(0, s * near - m)        near = 1 - 2^-21, then rounded to float
///
/// where s is the least distance of an end from the other segment, and m the margin of exact leaves; w = 0 where they surely cross.
///
/// Never too large. With D the distance of the outlines, |d| <= D + S, the placed ends are off by (turn) u |b| + (position) u |d|
/// <= 8.9 u S + 4.6 u D, and the grids; m holds what is of S and of the grids. Near takes off 8 u, of which 4.6 are for D and 1 for the
/// rounding of w. Where segments cross that do not surely do so, s is at most m, as V says.
/// So w is 0 where exact leaves let collide() say 1.
///
/// Below D by no more than m, 8.9 u S, the grids, and (4.6 + 8 + 1) u D: (segment_price), and 0.9 um per metre of D.
///
/// Which leaves have to be looked at. The nearest points of two outlines lie in two leaves that hold their segments. The gap of the discs of these
/// is at most D, see ClearanceMeasure, and so at most w + 2 m + 14 u D: most_gap().
template <class Simd>
class SegmentGaps {
 public:
  explicit SegmentGaps(const ShapeSetView& shapes) noexcept
      : leaves_{shapes.leaf_segments}, points_(shapes.points) {}

  /// Returns the largest gap of discs whose segments may have a gap of at most `best`.
  static float most_gap(const SegmentedPair& trees, float best) noexcept {
    return best * (1 + of_distance) + static_cast<float>(trees.margin) * 2.001f;
  }

  /// Collects all segments of a leaf of A with all of a leaf of B, named by the places of their discs. Measures those that were collected
  /// before where there is no room for more. take(gap, a, b) is called for pairs that are at most `best` apart, now or in
  /// finish(); segments are named by the points where they begin.
  /// Returns: false where a leaf has too many, so that discs decide.
  template <class Take>
  bool add(const Transform& b_in_a, const SegmentedPair& trees, std::uint32_t leaf_a, std::uint32_t leaf_b,
           const float& best, Take take) noexcept {
    const auto of_a = leaves_.segments(*trees.a, leaf_a), of_b = leaves_.segments(*trees.b, leaf_b);
    if (of_a.count * of_b.count == 0) return false;
    for (std::uint32_t i = 0; i < of_a.count; ++i)
      for (std::uint32_t j = 0; j < of_b.count; ++j) {
        if (size_ == capacity) finish(b_in_a, trees, best, take);
        a_[size_] = of_a.point(i), b_[size_++] = of_b.point(j);
      }
    return true;
  }

  /// Measures all that were collected.
  template <class Take>
  [[gnu::noinline]] void finish(const Transform& b_in_a, const SegmentedPair& trees, const float& best,
                                Take take) noexcept {
    for (std::uint32_t k = size_; k % Simd::width != 0; ++k) a_[k] = a_[size_ - 1], b_[k] = b_[size_ - 1];
    for (std::uint32_t k = 0; k < size_; k += Simd::width) {
      float gap[Simd::width];
      for (std::uint32_t bits = measure(b_in_a, trees.margin, k, best, gap); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<unsigned>(__builtin_ctz(bits));
        take(gap[lane], a_[k + lane], b_[k + lane]);
      }
    }
    size_ = 0;
  }

 private:
  using Float = typename Simd::Float;
  using Double = typename Simd::Double;
  using Ends = SegmentEnds<Simd>;
  static constexpr std::uint32_t capacity = 64;
  static_assert(capacity % Simd::width == 0);

  static constexpr double near = 1 - 0x1p-21;
  static constexpr float of_distance = 0x1p-19f;
  static_assert((1 - near) >= (clearance_terms::r::position + 2) * rounding::unit_roundoff);
  static_assert(double{of_distance} >= (2 * clearance_terms::r::position + 8 + 4) * rounding::unit_roundoff);
  static_assert(rounding::segment_margin >=
                (clearance_terms::r::segment_place + clearance_terms::r::higher) * rounding::unit_roundoff);

  /// Measures a register of pairs. Repeated ones at its end change nothing.
  /// Returns: bits of those whose gap is at most `best`.
  std::uint32_t measure(const Transform& b_in_a, double margin, std::uint32_t k, float best,
                        float* gap) const noexcept {
    const Ends p = Ends::load(points_, a_ + k), q = Ends::load(points_, b_ + k);
    const TransformOf<Double> placed{Double(double{b_in_a.c}), Double(double{b_in_a.s}),
                                     Double(double{b_in_a.tx}), Double(double{b_in_a.ty})};
    Double gaps[Ends::parts], sure[Ends::parts];
    for (std::uint32_t part = 0; part < Ends::parts; ++part) {
      const SegmentPair<Simd> pair = Ends::pair(p, q, placed, part);
      sure[part] =
          xsimd::min(pair.sides_of_p(Double(margin)).across(), pair.sides_of_q(Double(margin)).across());
      gaps[part] =
          xsimd::max(xsimd::sqrt(pair.square_of_ends()) * Double(near) - Double(margin), Double(0.0));
    }
    const Float is_sure = Simd::rounded(sure);
    const Float of_pairs = Simd::select(is_sure > Float(0.0f), Float(0.0f), Simd::rounded(gaps));
    Simd::store(gap, of_pairs);
    return Simd::bits(of_pairs <= Float(best));
  }

  const LeafSegments<Simd> leaves_;
  const Vec2* const points_;
  std::uint32_t size_ = 0;
  std::uint32_t a_[capacity], b_[capacity];  ///< points where segments begin
};

}  // namespace bch::detail
