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

/// Selects how two segments meet.
enum class Meeting : std::uint8_t {
  none,
  within_margin,  ///< they come within the margin of each other
  sure,           ///< they also cross despite all rounding; so two leaves and all their ancestors overlap
};

/// Returns the distance, metres, up to which segments of two shapes meet. (`Simd` keeps instruction sets from sharing a
/// function.)
template <class Simd>
double segment_margin(const ShapeSetView& shapes, std::uint32_t shape_a, std::uint32_t shape_b) noexcept {
  const double of_a = shapes.segment_margin[shape_a], of_b = shapes.segment_margin[shape_b];
  return of_a + of_b;
}

/// Tests exact leaves: whether segments of leaves meet, lane = pair.
/// Operations are a fixed sequence in double, which baselines/ repeats; layout/base/rounding.hpp, V, derives why no two
/// outlines that meet are missed.
template <class Simd>
class SegmentTest : private SegmentBatch<Simd> {
 public:
  using SegmentBatch<Simd>::SegmentBatch, SegmentBatch<Simd>::prefetch_words,
      SegmentBatch<Simd>::prefetch_points, SegmentBatch<Simd>::row;
  using typename SegmentBatch<Simd>::Row;

  /// Collects all pairs of a segment of leaf i of row a and a segment of leaf j of row b. (A row, LeafSegments::Row,
  /// is a run of consecutive leaves of a tree; i and j count from the first leaf of their rows.) `placed` is the
  /// index, in the array given to the constructor, of the transform of this pair of agents. `owner` is a number of the
  /// caller's for this pair of leaves. Calls use(owner, meeting) for each pair of segments that meets, now or in
  /// finish(). Leaves of too many segments are treated as within the margin.
  template <class Use>
  [[gnu::always_inline]] void add(std::uint32_t placed, const Row& a, std::uint32_t i, const Row& b,
                                  std::uint32_t j, std::uint32_t owner, Use use) noexcept {
    if (!this->collect(placed, a, i, b, j, owner, [&] { finish(use); })) [[unlikely]]
      use(owner, Meeting::within_margin);
  }

  /// Tests all pairs that were collected.
  template <class Use>
  [[gnu::noinline]] void finish(Use use) noexcept {
    measured_ = nothing;
    this->test_all([this](std::uint32_t k) { return test(k); },
                   [&](std::uint32_t k, unsigned lane) { use(this->owner(k + lane), meeting(k, k + lane)); });
  }

 private:
  using Batch = SegmentBatch<Simd>;
  using Float = typename Simd::Float;
  using Double = typename Simd::Double;
  using Batch::parts, Batch::capacity;
  using typename Batch::Pair;

  /// Computes for each pair apart_, above 0 where a line separates the segments, and sure_, above 0 where they surely
  /// cross.
  /// Returns: the bits of all pairs whose apart_ is at most 0, and perhaps of pairs where it is so little above 0 that
  ///          a float rounds it to 0.
  std::uint32_t test(std::uint32_t k) noexcept {
    Pair pairs[parts];
    this->load(k, pairs);
    Double apart[parts];
    for (std::uint32_t part = 0; part < parts; ++part) {
      const auto of_p = pairs[part].sides_of_p(pairs[part].margin),
                 of_q = pairs[part].sides_of_q(pairs[part].margin);
      apart[part] = xsimd::max(of_p.same_side(), of_q.same_side());
      Simd::store(apart_ + k + part * Simd::doubles, apart[part]);
      Simd::store(sure_ + k + part * Simd::doubles, xsimd::min(of_p.across(), of_q.across()));
    }
    return Simd::bits(Simd::to_float(apart) <= Float(0.0f));
  }

  Meeting meeting(std::uint32_t k, std::uint32_t lane) noexcept {
    if (apart_[lane] > 0) return Meeting::none;
    if (sure_[lane] > 0) return Meeting::sure;
    if (measured_ != k) measure(k);
    return beyond_[lane - k] <= 0 ? Meeting::within_margin : Meeting::none;
  }

  /// Measures by how much the pairs of the register from k on exceed the margin. About one pair in ten thousand needs this;
  /// if outlines coincide, most pairs do.
  [[gnu::noinline]] void measure(std::uint32_t k) noexcept {
    Pair pairs[parts];
    this->load(k, pairs);
    for (std::uint32_t part = 0; part < parts; ++part) {
      const Double margin = pairs[part].margin;
      Simd::store(beyond_ + part * Simd::doubles, pairs[part].square_of_ends() - margin * margin);
    }
    measured_ = k;
  }

  static constexpr std::uint32_t nothing = 0xffff'ffff;
  double apart_[capacity], sure_[capacity];
  double beyond_[Simd::width];  ///< of the register from measured_ on
  std::uint32_t measured_;
};

}  // namespace bch::detail
