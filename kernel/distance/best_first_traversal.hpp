// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/simd/disc_pairs.hpp"
#include "kernel/simd/transform.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds two nodes, of which at least one is a block, and the bounds of their pairs of discs.
struct NodePairBounds {
  alignas(64) float bound[block_pairs];
  std::uint64_t open;  ///< bits of the pairs not yet extracted
  std::uint32_t a, b;
};

/// Finds the least value of all pairs of discs of two cuts by branch and bound. `Measure` defines values:
///
///     Float bound(Float x, Float y, Float r)
///         of two discs as visit_disc_pairs() passes them, lane by lane: at most the value of any two discs
///         below them that is up to best(); far_beyond for padding
///     float best()
///         larger values are ignored; never increases
///     void measure_leaf_blocks(at, a, b, first_a, first_b)
///         compares the values of two leaf blocks, which begin at first_a and first_b, with the best
///
/// Of two nodes, the children with the least bound are visited first. Children with a bound above the best
/// are skipped.
template <class Simd, class Measure>
class BestFirstTraversal {
 public:
  explicit BestFirstTraversal(const float* nodes) noexcept : nodes_(nodes) {}

  /// Traverses everything below two nodes, of which at least one is a block.
  void run(const Transform& at, std::uint32_t a, std::uint32_t b, std::uint32_t stride_a,
           std::uint32_t stride_b, Measure& measure) noexcept {
    NodePairBounds* top = frames_;
    bound(at, a, b, stride_a, stride_b, measure, *top);
    bool found = extract_least(*top, measure.best(), a, b);
    for (;;) {
      if (!found) {
        if (top == frames_) return;
        --top;
        found = extract_next(*top, measure.best(), a, b);
      } else if ((a & b) >= leaf_bit) {
        measure_leaf_blocks(at, a, b, stride_a, stride_b, measure);
        found = extract_next(*top, measure.best(), a, b);
      } else {
        bound(at, a, b, stride_a, stride_b, measure, *++top);
        found = extract_least(*top, measure.best(), a, b);
      }
    }
  }

  /// Measures the discs of two leaf blocks.
  [[gnu::always_inline]] void measure_leaf_blocks(const Transform& at, std::uint32_t a, std::uint32_t b,
                                                  std::uint32_t stride_a, std::uint32_t stride_b,
                                                  Measure& measure) const noexcept {
    measure.measure_leaf_blocks(at, outer_discs(a, stride_a), outer_discs(b, stride_b), a & ~leaf_bit,
                                b & ~leaf_bit);
  }

  void bound(const Transform& at, std::uint32_t a, std::uint32_t b, std::uint32_t stride_a,
             std::uint32_t stride_b, const Measure& measure, NodePairBounds& frame) const noexcept {
    frame.a = a, frame.b = b, frame.open = ~std::uint64_t{0};
    visit_disc_pairs<Simd>(
        at, outer_discs(a, stride_a), outer_discs(b, stride_b),
        [&](unsigned k, Float x, Float y, Float r) { Simd::store(frame.bound + k, measure.bound(x, y, r)); });
  }

  /// Extracts the children with the least bound, unless it is above `best`. Nothing was extracted from
  /// `frame` before.
  bool extract_least(NodePairBounds& frame, float best, std::uint32_t& a, std::uint32_t& b) const noexcept {
    const float least = least_value<Simd>(frame.bound);
    extract(frame, first_within<Simd>(frame.bound, least), a, b);
    return least <= best;
  }

  /// Extracts the children with the least bound of those not yet extracted, unless it is above `best`.
  /// Usually all are, which is faster to find than the least; otherwise only a few are left to compare.
  bool extract_next(NodePairBounds& frame, float best, std::uint32_t& a, std::uint32_t& b) const noexcept {
    std::uint64_t left = all_within<Simd>(frame.bound, best) & frame.open;
    if (left == 0) return false;
    auto least = static_cast<unsigned>(__builtin_ctzll(left));
    while ((left &= left - 1) != 0) {
      const auto k = static_cast<unsigned>(__builtin_ctzll(left));
      least = frame.bound[k] < frame.bound[least] ? k : least;
    }
    extract(frame, least, a, b);
    return true;
  }

  Discs outer_discs(std::uint32_t node, std::uint32_t stride) const noexcept {
    return TreeNodes<Simd>::outer_discs(nodes_, node, stride);
  }

  /// Returns the child of a node in a lane; a leaf block is its own child.
  std::uint32_t child(std::uint32_t node, unsigned lane) const noexcept {
    return node >= leaf_bit ? node : TreeNodes<Simd>::child(nodes_, node, lane);
  }

 private:
  using Float = typename Simd::Float;
  /// The depth of the stack: every step descends in at least one tree, and no tree has more than
  /// max_wide_levels levels.
  static constexpr std::uint32_t max_frames = 2 * max_wide_levels;

  void extract(NodePairBounds& frame, unsigned k, std::uint32_t& a, std::uint32_t& b) const noexcept {
    const unsigned i = k / block_width, j = k % block_width;
    a = child(frame.a, i), b = child(frame.b, j);
    std::uint64_t extracted = std::uint64_t{1} << k;
    // If one node is a leaf block, it is visited whole with the child of the other. That visit covers the child's
    // pairs with all discs of the leaf block, so all of these are extracted.
    if (frame.a >= leaf_bit) extracted |= first_column_of_pairs << j;
    if (frame.b >= leaf_bit) extracted |= first_row_of_pairs << (k - j);
    frame.open &= ~extracted;
  }

  const float* nodes_;
  NodePairBounds frames_[max_frames + 1];
};

}  // namespace bch::detail
