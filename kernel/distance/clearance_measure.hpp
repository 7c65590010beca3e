// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/distance/clearance_arguments.hpp"
#include "kernel/distance/clearance_terms.hpp"
#include "kernel/distance/segment_gaps.hpp"
#include "kernel/simd/disc_pairs.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Measures the gap between two discs, in float:
///
///     v = sqrt(x^2 + y^2) * gap_factor - (r_A + r_B)            gap_factor = 1 - 2^-20
///
/// (x, y) leads from A's centre to B's, in A's frame. u, S (the sum of both extents), P_B (the extent of B) and d
/// (the position of B relative to A) are those of layout/base/rounding.hpp. D is the distance of the exact
/// centres, so |d| <= D + S.
///
/// v is never too large. Its errors are at most:
///
///     (1) sqrt(x^2 + y^2): 8.1 u P_B + 5.6 u |d| for B's placement and the sum p, and 3 u D for the
///         difference, the squares with their sum, and the root. Together 13.7 u S + 8.6 u D
///     (2) the product: u D; the sum of radii: u S; the last difference: u D or u S
///     (3) in total 15.7 u S + 10.6 u D
///
/// Stored radii include 16.5 u S (contact_error), and gap_factor subtracts 16 u D. Both exceed (3).
///
/// Bounds of nodes are never larger than gaps of discs in them. Let a node's disc (C, R) contain a disc (c, r)
/// of the cut, and D' be the distance of the nodes' centres. Then D' <= D + 2 S, and D' - (R_A + R_B) <= D -
/// (r_A + r_B). The bound v' is v of the nodes, with bound_factor = 1 - 2^-18 instead of gap_factor.
///
///     (4) v' exceeds D' - (R_A + R_B) by at most 17.7 u S + 7.6 u D for the distance, 9 u S + 4 u D for the
///         operations after it, and 3 u S + u D for the slack, which is added to the sum of radii. (This
///         assumes R_A + R_B <= D' + S. If not, v' is below every v.)
///     (5) v is smaller than D - (r_A + r_B) by at most 15.7 u S + 26.6 u D
///     (6) in total 45.4 u S + 39.2 u D
///
/// For these, `slack` subtracts 64 u S, and bound_factor 64 u D. So v' <= v, and pruning of bounds above the
/// best gap never loses a tie. The root of v' is approximate_sqrt(), reduced by more than its error.
///
/// clearance_terms.hpp checks these sums. Without the slack, tests/kernel/queries_test.cpp finds other discs
/// than brute force does, for a tiny shape in a disc of a shape that is far from its own origin. Only the
/// proof needs bound_factor < gap_factor.
template <class Simd>
class ClearanceMeasure {
 public:
  using Float = typename Simd::Float;

  using Segments = SegmentGaps<Simd, ClearanceMeasure>;

  /// `limit`: larger gaps are not searched for. `stop_below`: a gap at most that large ends the search.
  /// `max_extent`: S, metres.
  ClearanceMeasure(float limit, float stop_below, float max_extent) noexcept
      : stop_below_(stop_below), slack_(slack_per_extent * max_extent) {
    search_within({limit, false, no_node, no_node});
  }
  ClearanceMeasure() = default;

  /// Measures between the segments of two trees, which have segments, as search `number` of `segments`.
  /// `probes`: of the first leaf blocks, only the two nearest leaves are stored.
  void use_segments(Segments* segments, std::uint32_t number, const Tree& a, const Tree& b, double margin,
                    bool probes) noexcept {
    segments_ = segments, number_ = number, tree_a_ = &a, tree_b_ = &b, probes_ = probes;
    margin_ = static_cast<float>(margin);
    search_within(nearest_);
  }

  /// a and b: indices of discs among the nodes, or of the first points of segments; or no_node.
  struct Nearest {
    float distance;
    bool are_discs;
    std::uint32_t a, b;
  };
  const Nearest& nearest() const noexcept { return nearest_; }
  /// Returns the largest gap of leaf discs that may contain features nearer than the best ones.
  float best() const noexcept { return best_; }

  Float bound(Float x, Float y, Float r) const noexcept { return rough_gap(x, y, r + Float(slack_)); }
  static Float bound(Float x, Float y, Float r, Float max_extent) noexcept {
    return rough_gap(x, y, r + Float(slack_per_extent) * max_extent);
  }

  /// Returns which pairs of two blocks or leaf blocks may improve on the best, without square roots:
  ///
  ///     v <= best   =>   sqrt(x^2 + y^2) <= (r + best + u |best|) (1 + 19 u)
  ///
  /// The slack, 8 u |best|, and the factor 1 - 128 u of the square exceed these terms and the rounding here.
  typename Simd::Mask may_improve(Float x, Float y, Float r) const noexcept {
    const Float sum = r + Float(most_);
    return (x * x + y * y) * Float(square_factor) <= sum * sum;
  }

  /// Measures all gaps of two leaf blocks before any is compared with the best, because a branch per gap would be
  /// unpredictable.
  [[gnu::always_inline]] void measure_leaf_blocks(const Transform& at, Discs a, Discs b,
                                                  std::uint32_t first_a, std::uint32_t first_b) noexcept {
    if (segments_ != nullptr) return collect_leaves(at, a, b, first_a, first_b);
    alignas(64) float gaps[block_pairs];
    visit_disc_pairs<Simd>(
        at, a, b, [&](unsigned k, Float x, Float y, Float r) { Simd::store(gaps + k, gap(x, y, r)); });
    const float least = least_value<Simd>(gaps);
    if (!(least <= best())) return;
    const unsigned k = first_within<Simd>(gaps, least);
    update_from_discs(least, first_a + k / block_width, first_b + k % block_width);
  }

  /// Ends probing: from now on, all leaves are stored. Returns whether there were leaf blocks of which only two
  /// leaves were stored, and their names.
  bool end_probe(std::uint32_t& a, std::uint32_t& b) noexcept {
    const bool probed = probed_a_ != 0;
    a = probed_a_, b = probed_b_;
    probes_ = false, probed_a_ = 0;
    return probed;
  }

  /// Returns 64 u S, metres.
  float slack() const noexcept { return slack_; }
  const Tree& tree_a() const noexcept { return *tree_a_; }
  const Tree& tree_b() const noexcept { return *tree_b_; }
  void update_from_discs(float gap, std::uint32_t a, std::uint32_t b) noexcept { update({gap, true, a, b}); }
  void update_from_segments(float gap, std::uint32_t a, std::uint32_t b) noexcept {
    update({gap, false, a, b});
  }

  /// Returns the gaps of pairs of discs, one per lane.
  static Float gap(Float x, Float y, Float r) noexcept {
    const Float square = x * x + y * y;
    return Simd::select(square <= Float(far_beyond), xsimd::sqrt(square) * Float(gap_factor) - r,
                        Float(far_beyond));
  }

 private:
  static constexpr float slack_per_extent = 0x1p-18f;
  static constexpr float gap_factor = 1 - 0x1p-20f, bound_factor = 1 - 0x1p-18f, root_factor = 1 + 0x1p-20f;
  static constexpr float square_factor = 1 - 0x1p-17f, best_slack = 0x1p-21f;

  static constexpr double u = rounding::unit_roundoff;
  static_assert(double{slack_per_extent} >= clearance_terms::slack * u);
  static_assert(1 - double{gap_factor} >= clearance_terms::shortening * u);
  static_assert(1 - double{bound_factor} >= clearance_terms::bound_shortening * u);
  static_assert(1 - double{square_factor} >= clearance_terms::square_shortening * u);
  static_assert(double{best_slack} >= 3 * u, "u |best| and the rounding of the sums");

  static Float rough_gap(Float x, Float y, Float r) noexcept {
    const Float square = x * x + y * y;
    const Float root = approximate_sqrt<Simd>(square) * Float(bound_factor * (1 - Simd::approximation_error));
    // For padding, the square is infinite or NaN.
    return Simd::select(square <= Float(far_beyond), root - r, Float(far_beyond));
  }

  /// Bounds the least gap of segments by the discs of two leaf blocks, and stores the leaves that may contain it.
  [[gnu::noinline]] void collect_leaves(const Transform& at, Discs a, Discs b, std::uint32_t first_a,
                                        std::uint32_t first_b) noexcept {
    alignas(64) float gaps[block_pairs], squares[block_pairs];
    visit_disc_pairs<Simd>(at, a, b, [&](unsigned k, Float x, Float y, Float r) {
      const Float square = x * x + y * y;
      Simd::store(gaps + k, gap(x, y, r));
      Simd::store(squares + k, Simd::select(square <= Float(far_beyond), square + r * r, Float(far_beyond)));
    });
    const float least = least_value<Simd>(gaps);
    if (!(least <= best_)) return;
    if (probes_) {
      probes_ = false, probed_a_ = first_a | leaf_bit, probed_b_ = first_b | leaf_bit;
      const unsigned k = first_within<Simd>(gaps, least);
      return segments_->add(number_, *this, first_a + k / block_width, first_b + k % block_width, gaps[k]);
    }
    const float most = __builtin_sqrtf(least_value<Simd>(squares)) * root_factor + slack_;
    if (max_gap(most) < best_) bound_by(max_gap(most));
    for (std::uint64_t left = all_within<Simd>(gaps, best_); left != 0; left &= left - 1) {
      const auto k = static_cast<unsigned>(__builtin_ctzll(left));
      segments_->add(number_, *this, first_a + k / block_width, first_b + k % block_width, gaps[k]);
    }
  }

  /// Replaces the nearest features by others that are nearer, or as near and first in order: segments before
  /// discs, then lower indices.
  void update(const Nearest& other) noexcept {
    if (other.distance > nearest_.distance) return;
    const bool is_before = other.are_discs != nearest_.are_discs ? nearest_.are_discs
                           : other.a != nearest_.a               ? other.a < nearest_.a
                                                                 : other.b < nearest_.b;
    if (other.distance < nearest_.distance || is_before || nearest_.a == no_node) set(other);
  }

  void set(const Nearest& nearest) noexcept {
    nearest_ = nearest;
    const float gap = max_gap(nearest.distance);
    if (gap < best_) bound_by(gap);
    // Every comparison with these is false, so the search ends.
    if (nearest.distance <= stop_below_)
      nearest_.distance = best_ = -__builtin_inff(), most_ = __builtin_nanf("");
  }

  void search_within(const Nearest& nearest) noexcept {
    nearest_ = nearest;
    bound_by(max_gap(nearest.distance));
  }

  /// Returns the largest gap of leaf discs that may contain features at that distance.
  float max_gap(float distance) const noexcept {
    return segments_ == nullptr ? distance : Segments::max_gap(margin_, distance);
  }

  void bound_by(float gap) noexcept {
    best_ = gap;
    most_ = gap + best_slack * __builtin_fabsf(gap) + slack_;
  }

  Segments* segments_ = nullptr;
  const Tree *tree_a_, *tree_b_;
  std::uint32_t number_;
  std::uint32_t probed_a_ = 0, probed_b_ = 0;  ///< leaf blocks; 0: none
  bool probes_ = false;
  float margin_;
  Nearest nearest_;
  float best_;
  float stop_below_, slack_;
  float most_;  ///< the best plus its slack, for may_improve()
};

}  // namespace bch::detail
