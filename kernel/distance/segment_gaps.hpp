// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/segment_pairs.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Measures, for clearance(), the gaps between segments of exact leaves, one pair of segments per lane. In
/// double, from the placed ends of B's segments, which are floats:
///
///     w = max(0, s * gap_factor - m)        gap_factor = 1 - 2^-21, then rounded to float
///
/// s is the least distance of an end from the other segment, and m the margin of exact leaves. Pairs of
/// agents for which collide() returns 1 have a distance of 0 and are not measured, so no two segments cross.
///
/// Let D be the distance of the outlines, S the sum of both extents, d and u those of layout/base/rounding.hpp.
/// Then |d| <= D + S.
///
///     (1) The placed ends are off by (turn) u |b| + (position) u |d| <= 8.9 u S + 4.6 u D, and by the grids.
///     (2) w is never too large: m covers 8.9 u S and the grids. gap_factor subtracts 8 u D, which covers
///         4.6 u D and u D for the rounding.
///     (3) w is too small by at most m + 8.9 u S + the grids + (4.6 + 8 + 1) u D. That is (segment_price), and
///         0.9 um per metre of D.
///
/// Which leaves are examined:
///
///     (4) The nearest points of two outlines lie in two leaves whose discs have a gap of at most D (see
///         ClearanceMeasure). With (3), that is at most w + 2 m + 14 u D: max_gap().
///     (5) Two leaves whose centres are D' apart have w <= sqrt(D'^2 + r_A^2 + r_B^2). Reason: every half of a
///         smallest enclosing disc has a point of its content on its circle. In the half that faces a point
///         at distance D' from the centre, it is at most sqrt(D'^2 + r^2) away from that point.
///
/// So the search compares discs alone, and stores the leaves that may contain the nearest segments. finish()
/// measures these, after the first leaves of all searches and at the end.
///
/// Which pairs of segments are measured in double. The distance s of each pair is first computed in float, as
/// f, for all pairs of one search with one placement:
///
///     (6) |f - s| <= 30 u S + 14 u D: 6 u S + 2 u D for B's ends placed in float, and 12 u (D + 2 S) for the
///         steps to the nearest point.
///     (7) The least w of all pairs is at most f * longer + slack (64 u S) of every pair. It is also at most
///         the least w found so far. The lesser of these is the bound.
///     (8) A pair can reach that bound only if its f is at most (bound + m + slack) * longer.
///
/// About one pair in four remains.
///
/// `Search` is the search of one pair of agents:
///
///     const Tree &tree_a(), &tree_b()
///     float best()                                                   leaves with a larger gap are skipped
///     float nearest().distance                                       a larger w is ignored
///     float slack()                                                  64 u S
///     void update_from_segments(float w, uint32 a, uint32 b)         a, b: the segments' first points
///     void update_from_discs(float gap, uint32 a, uint32 b)          for leaves with too many segments
template <class Simd, class Search>
class SegmentGaps : private SegmentBatch<Simd> {
 public:
  static constexpr std::uint32_t max_searches = 32;  ///< that may have stored leaves at the same time

  explicit SegmentGaps(const ShapeSetView& shapes) noexcept : SegmentBatch<Simd>(shapes, places_) {}

  /// Sets the relative placement and the margin of a search.
  void place(std::uint32_t search, const Transform& b_in_a, double margin) noexcept {
    places_[search] = {b_in_a, margin};
  }

  /// Returns the largest gap of discs whose segments may have a gap of at most `best`: (4).
  static float max_gap(float margin, float best) noexcept { return best * (1 + gap_slack) + margin * 2.001f; }

  /// Stores two leaves with the gap of their discs, for finish(). `search` must not move until then.
  void add(std::uint32_t number, Search& search, std::uint32_t leaf_a, std::uint32_t leaf_b,
           float gap) noexcept {
    if (open_size_ == open_capacity) finish();
    open_[open_size_] = {leaf_a, leaf_b, gap, last_[number]};
    searches_[number] = &search;
    last_[number] = ++open_size_;
  }

  /// Returns the largest distance of segments that may be as near as the nearest so far: (8).
  float max_distance(std::uint32_t number, const Search& search) const noexcept {
    return max_distance(number, search, search.nearest().distance);
  }
  /// Measures the pairs of segments for which visit(use) calls use(a, b). No leaves are stored.
  template <class Visit>
  void measure_pairs(std::uint32_t number, Search& search, Visit visit) noexcept {
    searches_[number] = &search;
    const auto measure = [&] { measure_collected(number); };
    visit([&](std::uint32_t a, std::uint32_t b) { this->append(number, a, b, number, measure); });
    measure();
  }

  /// Measures the segments of all stored leaves that may still contain the nearest ones.
  void finish() noexcept {
    if (open_size_ != 0) measure_all();
  }

 private:
  using Batch = SegmentBatch<Simd>;
  using Float = typename Simd::Float;
  using Double = typename Simd::Double;
  using Batch::parts;
  static constexpr std::uint32_t open_capacity = 1024;

  static constexpr double gap_factor = 1 - 0x1p-21;
  static constexpr float gap_slack = 0x1p-19f, longer = 1 + 0x1p-16f;
  static constexpr double u = rounding::unit_roundoff;
  static_assert((1 - gap_factor) >= (rounding::terms::position + 2) * u);
  static_assert(double{gap_slack} >= (2 * rounding::terms::position + 8 + 4) * u);
  static_assert(rounding::segment_margin >= (rounding::terms::segment_place + rounding::terms::higher) * u);

  struct Leaves {
    std::uint32_t a, b;
    float gap;
    std::uint32_t before;  ///< 1 + the index of the same search's leaves before, or 0
  };

  [[gnu::noinline]] void measure_all() noexcept {
    for (std::uint32_t number = 0; number < max_searches; ++number) {
      if (last_[number] == 0) continue;
      Search& search = *searches_[number];
      for (std::uint32_t left = last_[number]; left != 0;) {
        const Leaves& leaves = open_[left - 1];
        left = leaves.before;
        if (leaves.gap > search.best()) continue;
        if (!this->collect(number, this->row(search.tree_a(), leaves.a), 0,
                           this->row(search.tree_b(), leaves.b), 0, number,
                           [&] { measure_collected(number); }))
          search.update_from_discs(leaves.gap < 0 ? 0 : leaves.gap, leaves.a, leaves.b);
      }
      measure_collected(number);
      last_[number] = 0;
    }
    open_size_ = 0;
  }

  /// Measures all pairs that were collected. They are of one search.
  [[gnu::noinline]] void measure_collected(std::uint32_t number) noexcept {
    if (this->size() > Simd::width) retain_nearest(number);
    float gap[Simd::width];
    this->test_all([&](std::uint32_t k) { return measure(k, gap); },
                   [&](std::uint32_t k, unsigned lane) {
                     searches_[number]->update_from_segments(gap[lane], this->segment_a(k + lane),
                                                             this->segment_b(k + lane));
                   });
  }

  /// Retains the pairs that may be nearest, by their distances in float: (8).
  void retain_nearest(std::uint32_t number) noexcept {
    const Search& search = *searches_[number];
    const auto b_in_a = places_[number].b_in_a.template in_lanes<Float>();
    alignas(64) float squares[Batch::capacity];
    Float least(__builtin_inff());
    this->fill_register();
    for (std::uint32_t k = 0; k < this->size(); k += Simd::width) {
      const Float square = this->load(k, b_in_a).square_of_ends();
      Simd::store(squares + k, square);
      least = xsimd::min(square, least);
    }
    const float bound = __builtin_sqrtf(Simd::least(least)) * longer + search.slack(),
                best = search.nearest().distance;
    const float limit = max_distance(number, search, bound < best ? bound : best);
    this->retain(
        [&](std::uint32_t k) { return Simd::bits(Simd::load(squares + k) <= Float(limit * limit)); });
  }

  float max_distance(std::uint32_t number, const Search& search, float least) const noexcept {
    return (least + static_cast<float>(places_[number].margin) + search.slack()) * longer;
  }

  /// Measures one pair per lane. Returns: the bits of all lanes.
  std::uint32_t measure(std::uint32_t k, float* gap) const noexcept {
    typename Batch::Pair pairs[parts];
    this->load(k, pairs);
    Double gaps[parts];
    for (std::uint32_t part = 0; part < parts; ++part) {
      const auto& pair = pairs[part];
      gaps[part] =
          xsimd::max(xsimd::sqrt(pair.square_of_ends()) * Double(gap_factor) - pair.margin, Double(0.0));
    }
    Simd::store(gap, Simd::to_float(gaps));
    return ~std::uint32_t{0} >> (32 - Simd::width);
  }

  PlacedSegments places_[max_searches];
  Search* searches_[max_searches];
  std::uint32_t last_[max_searches] = {};  ///< counted as Leaves::before
  std::uint32_t open_size_ = 0;
  Leaves open_[open_capacity];
};

}  // namespace bch::detail
