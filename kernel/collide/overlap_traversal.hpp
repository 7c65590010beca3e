// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernel/simd/ancestor_test.hpp"
#include "kernel/simd/arguments.hpp"
#include "kernel/simd/disc_pairs.hpp"
#include "kernel/simd/gaps.hpp"
#include "kernel/simd/segment_test.hpp"
#include "kernel/simd/stage.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Implements stages 6 and 7 of "Stages" in kernel/README.md: traverses the trees of the pairs that no quicker stage
/// decided, in rounds. Each round tests one pair of blocks for every undecided pair, so that cache misses and latencies
/// of many pairs overlap and no branch depends on an answer. Ancestors are tested only if leaves overlap. Most pairs end
/// after a few rounds. The rest wait until more pairs are added, because a round over three pairs takes as long as one
/// over thirty.
/// `capacity`: the most undecided pairs; run(stop_below) makes room for add().
template <class Simd, std::uint32_t capacity>
class OverlapTraversal {
 public:
  OverlapTraversal(const ShapeSetView& shapes, const Arguments& arguments) noexcept
      : shapes_(shapes),
        states_(arguments.states),
        exact_leaves_(arguments.exact_leaves),
        segments_(shapes, placed_) {}

  /// Adds a pair, whose state, at index `pair`, stays `state_without_hit` unless the traversal finds a hit.
  /// `max_extent`: the sum of the two shapes' extents. `margin`: the sum of their segments' margins, 0 if discs decide. `gaps`
  /// are read if KnowsGaps.
  void add(std::size_t pair, std::uint8_t state_without_hit, const Transform& b_in_a, std::uint32_t root_a,
           std::uint32_t root_b, float max_extent, double margin, Gaps gaps) noexcept {
    const Tree a = shapes_.trees[root_a], b = shapes_.trees[root_b];
    if (a.segments == no_segments || b.segments == no_segments) margin = 0;
    // Slots are numbered when they are first needed, because small batches need few.
    if (size_ == numbered_) slots_[size_] = static_cast<std::uint16_t>(numbered_++);
    const std::uint32_t slot = slots_[size_++];
    traversals_[slot] = {b_in_a, a.top,      b.top, a.stride, b.stride, root_a,
                         root_b, max_extent, 0,     pair,     margin,   {}};
    if constexpr (KnowsGaps<Simd>) traversals_[slot].gaps = gaps;
    frames_[slot][0] = {0, 0, 0};  // a sentinel: no unvisited overlaps, so the pair ends here
    states_[pair] = state_without_hit;
  }

  /// Runs rounds until at most `stop_below` pairs are undecided.
  void run(std::uint32_t stop_below) noexcept {
    if (size_ > stop_below) rounds(stop_below);
  }

 private:
  using Nodes = TreeNodes<Simd>;
  /// How many tests ahead blocks are prefetched.
  static constexpr std::uint32_t tests_ahead = 6;
  static constexpr std::uint32_t verified_together = 32;
  /// The most frames of a pair: every test descends in at least one of the trees, which have at most max_wide_levels
  /// levels.
  static constexpr std::uint32_t max_frames = 2 * max_wide_levels;

  struct NoGaps {};

  /// Represents a pair whose trees are being traversed, with the two blocks to test next.
  struct Traversal {
    Transform b_in_a;
    std::uint32_t a, b;
    std::uint32_t stride_a, stride_b;
    std::uint32_t root_a, root_b;
    float max_extent;
    std::uint32_t stack_top;  ///< frame
    std::size_t pair;
    double margin;  ///< metres; 0: discs decide, not segments
    [[no_unique_address]] std::conditional_t<KnowsGaps<Simd>, Gaps, NoGaps> gaps;
  };

  /// Holds two blocks, and a bit for each pair of overlapping discs whose children are not tested yet (8 i + j: disc i
  /// of A, disc j of B).
  struct Frame {
    std::uint32_t a, b;
    std::uint64_t unvisited;
  };

  /// Tests every undecided pair, then steps every pair. These are two loops, because out-of-order execution overlaps
  /// the iterations of each loop, but would hardly overlap those of one fused loop. Everything is in one function,
  /// because a round over one pair is so short that calls matter. `noipa`, because GCC 12's interprocedural passes
  /// otherwise judge this function to have no effects, and drop its calls.
  [[gnu::noipa]] void rounds(std::uint32_t stop_below) noexcept {
    while (size_ > stop_below) {
      const std::uint32_t tests = size_;
      test();
      end_stage<Simd>(Stage::blocks, tests);
      end_stage<Simd>(Stage::leaves, verify());
      step();
      end_stage<Simd>(Stage::blocks, 0);
    }
  }

  [[gnu::always_inline]] void test() noexcept {
    const float* const nodes = shapes_.nodes;
    for (std::uint32_t k = 0; k < size_; ++k) {
      if (k + tests_ahead < size_) {
        const Traversal& next = traversals_[slots_[k + tests_ahead]];
        Nodes::prefetch(nodes, next.a, next.stride_a);
        Nodes::prefetch(nodes, next.b, next.stride_b);
      }
      const Traversal& at = traversals_[slots_[k]];
      overlaps_[k] = overlaps_of(at, at.a, at.b);
    }
  }

  [[gnu::always_inline]] std::uint64_t overlaps_of(const Traversal& pair, std::uint32_t a,
                                                   std::uint32_t b) const noexcept {
    const float* const nodes = shapes_.nodes;
    if constexpr (KnowsGaps<Simd>)
      return near_discs<Simd>(pair.b_in_a, Nodes::outer_discs(nodes, a, pair.stride_a),
                              Nodes::outer_discs(nodes, b, pair.stride_b), radius_factor,
                              (a & b) >= leaf_bit ? pair.gaps.leaf : pair.gaps.bound);
    return overlapping_discs<Simd>(pair.b_in_a, Nodes::discs(nodes, a, pair.stride_a),
                                   Nodes::discs(nodes, b, pair.stride_b));
  }

  /// Returns 1 if both nodes are leaf blocks, else 0. A leaf block is a leaf: eight discs of the cut. Its name is the
  /// position of its first disc in ShapeSetView::nodes, with the top bit, leaf_bit, set.
  [[gnu::always_inline]] static std::uint32_t both_are_leaf_blocks(const Traversal& at) noexcept {
    return (at.a & at.b) / leaf_bit;
  }

  /// Clears the overlaps of leaves whose segments do not meet or whose ancestors do not all overlap, up to each pair's
  /// first verified hit. Returns how many pairs have overlapping leaves.
  [[gnu::always_inline]] std::uint32_t verify() noexcept {
    // Leaf discs within their gap are a hit, whatever their ancestors.
    if constexpr (KnowsGaps<Simd>) return 0;
    std::uint16_t found[verified_together + 1];
    std::uint32_t count = 0, all = 0;
    for (std::uint32_t k = 0; k < size_; ++k) {
      const Traversal& at = traversals_[slots_[k]];
      found[count] = static_cast<std::uint16_t>(k);
      count += both_are_leaf_blocks(at) & static_cast<std::uint32_t>(overlaps_[k] != 0);
      if (count == verified_together) [[unlikely]]
        verify(found, count), all += count, count = 0;
    }
    verify(found, count);
    return all + count;
  }

  void verify(std::uint16_t* which, std::uint32_t count) noexcept {
    if (exact_leaves_) count = compare_segments(which, count);
    verify_overlaps(which, count);
  }

  /// Keeps the overlaps of leaves whose segments meet. A pair whose segments surely cross keeps all its overlaps.
  /// Returns: how many pairs have overlaps whose ancestors have to be tested; these come first.
  std::uint32_t compare_segments(std::uint16_t* which, std::uint32_t count) noexcept {
    std::uint64_t within_margin[verified_together];
    std::uint32_t is_sure = 0, is_compared = 0;
    static_assert(verified_together <= 32);
    const auto on_meeting = [&](std::uint32_t owner, Meeting meeting) {
      const std::uint32_t i = owner / block_pairs;
      is_sure |= std::uint32_t{meeting == Meeting::sure} << i;
      within_margin[i] |= std::uint64_t{meeting == Meeting::within_margin} << owner % block_pairs;
    };
    Compared compared[verified_together + 1];
    std::uint32_t pairs = 0, all_overlaps = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Traversal& at = traversals_[slots_[which[i]]];
      within_margin[i] = 0;
      if (at.margin == 0) [[unlikely]]
        continue;
      is_compared |= std::uint32_t{1} << i;
      placed_[i] = {at.b_in_a, at.margin};
      const Tree &a = shapes_.trees[at.root_a], &b = shapes_.trees[at.root_b];
      const Compared& added = compared[pairs++] = {segments_.row(a, at.a & ~leaf_bit),
                                                   segments_.row(b, at.b & ~leaf_bit),
                                                   a.count,
                                                   b.count,
                                                   overlaps_[which[i]],
                                                   i};
      all_overlaps += static_cast<unsigned>(__builtin_popcountll(added.overlaps));
      segments_.prefetch_words(added.a), segments_.prefetch_words(added.b);
    }
    for (std::uint32_t k = 0; k < pairs; ++k) {
      segments_.prefetch_points(compared[k].a, compared[k].leaves_a);
      segments_.prefetch_points(compared[k].b, compared[k].leaves_b);
    }
    // One loop over the overlaps of all pairs: a loop for each pair would mispredict its end each time.
    for (std::uint32_t k = 0; all_overlaps > 0; --all_overlaps) {
      Compared& at = compared[k];
      const auto bit = static_cast<unsigned>(__builtin_ctzll(at.overlaps));
      segments_.add(at.pair, at.a, bit / block_width, at.b, bit % block_width, at.pair * block_pairs + bit,
                    on_meeting);
      at.overlaps &= at.overlaps - 1;
      k += at.overlaps == 0;
    }
    segments_.finish(on_meeting);
    std::uint32_t left = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint16_t k = which[i];
      const bool sure = is_sure >> i & 1;
      if (is_compared >> i & 1 && !sure) overlaps_[k] = within_margin[i];
      which[left] = k;
      left += !sure & (overlaps_[k] != 0);
    }
    return left;
  }

  /// Verifies one overlap of every pair per pass, until one is a hit or none is left. The ancestors of many pairs are found
  /// side by side, because each step waits for the one before.
  void verify_overlaps(std::uint16_t* which, std::uint32_t count) noexcept {
    const float* const nodes = shapes_.nodes;
    AncestorPath<Simd>*const ancestors_a = ancestors_a_, *const ancestors_b = ancestors_b_;
    while (count > 0) {
      for (std::uint32_t i = 0; i < count; ++i) {
        const Traversal& at = traversals_[slots_[which[i]]];
        const auto [disc_a, disc_b] = first_overlap(at, overlaps_[which[i]]);
        ancestors_a[i].begin(nodes, shapes_.trees[at.root_a], disc_a);
        ancestors_b[i].begin(nodes, shapes_.trees[at.root_b], disc_b);
      }
      for (std::uint32_t k = 1; k < AncestorPath<Simd>::length; ++k)
        for (std::uint32_t i = 0; i < count; ++i)
          ancestors_a[i].step(nodes, k), ancestors_b[i].step(nodes, k);
      std::uint32_t left = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint16_t k = which[i];
        const Traversal& at = traversals_[slots_[k]];
        const auto [disc_a, disc_b] = first_overlap(at, overlaps_[k]);
        const PlacedTrees trees{at.b_in_a, shapes_.trees[at.root_a], shapes_.trees[at.root_b], at.max_extent};
        const bool stays =
            AncestorTest<Simd>(nodes, trees, disc_a, disc_b, ancestors_a[i], ancestors_b[i]).passes();
        if (!stays) overlaps_[k] &= overlaps_[k] - 1;
        which[left] = k;
        left += !stays & (overlaps_[k] != 0);
      }
      count = left;
    }
  }

  /// Represents two leaf blocks whose leaves are compared by their segments.
  struct Compared {
    typename SegmentTest<Simd>::Row a, b;
    std::uint32_t leaves_a, leaves_b;  ///< how many each tree has
    std::uint64_t overlaps;
    std::uint32_t pair;  ///< index among those compared
  };

  struct LeafPair {
    std::uint32_t a, b;  ///< indices in ShapeSetView::nodes
  };
  /// Returns the leaves of the first overlap of two leaf blocks.
  static LeafPair first_overlap(const Traversal& at, std::uint64_t overlaps) noexcept {
    const auto bit = static_cast<unsigned>(__builtin_ctzll(overlaps));
    return {(at.a & ~leaf_bit) + bit / block_width, (at.b & ~leaf_bit) + bit % block_width};
  }

  /// Decides pairs whose leaves overlap. For each other pair, pushes the overlaps found, takes the next unvisited one, and
  /// sets the blocks to test: the children of the two discs, or, if one block is a leaf block already, that leaf block and the
  /// other's child. What is computed for a decided pair is never used, which beats a branch that no processor can predict.
  /// The slots of decided pairs end up behind the others.
  [[gnu::always_inline]] void step() noexcept {
    const float* const nodes = shapes_.nodes;
    std::uint8_t* const states = states_;
    const std::uint32_t size = size_;
    std::uint32_t left = 0;
    for (std::uint32_t k = 0; k < size; ++k) {
      const std::uint16_t slot = slots_[k];
      Traversal& at = traversals_[slot];
      const std::uint64_t overlaps = overlaps_[k];
      const std::uint32_t any = overlaps != 0, hit = both_are_leaf_blocks(at) & any;
      states[at.pair] = static_cast<std::uint8_t>(states[at.pair] | hit);

      Frame* const frames = frames_[slot];
      frames[at.stack_top + 1] = {at.a, at.b, overlaps};
      const std::uint32_t new_top = at.stack_top + any;
      Frame& top = frames[new_top];
      const std::uint64_t unvisited = top.unvisited;
      const Frame next = first_below(nodes, top);
      at.a = next.a, at.b = next.b;
      top.unvisited = next.unvisited;
      at.stack_top = new_top - (next.unvisited == 0);
      slots_[k] = slots_[left];
      slots_[left] = slot;
      left += (unvisited != 0) & (hit ^ 1);
    }
    size_ = left;
  }

  /// Returns the two blocks to test next, below the first unvisited overlap (any, if there is none), and the overlaps that
  /// stay unvisited.
  [[gnu::always_inline]] static Frame first_below(const float* nodes, const Frame& at) noexcept {
    std::uint64_t rest = at.unvisited & (at.unvisited - 1);
    const auto bit = static_cast<unsigned>(__builtin_ctzll(at.unvisited | std::uint64_t{1} << 63));
    const unsigned i = bit / block_width, j = bit % block_width;
    if ((at.a | at.b) < leaf_bit) [[likely]]
      return {Nodes::child(nodes, at.a, i), Nodes::child(nodes, at.b, j), rest};
    std::uint32_t a = at.a, b = at.b;
    // If one node is a leaf block, only the other node is descended. The next test is of that child and the whole leaf block,
    // so it covers all overlaps between the child and the leaf block's discs: these are removed from `rest`.
    if (a < leaf_bit) a = Nodes::child(nodes, a, i), rest &= ~(first_row_of_pairs << (bit - j));
    if (b < leaf_bit) b = Nodes::child(nodes, b, j), rest &= ~(first_column_of_pairs << j);
    return {a, b, rest};
  }

  const ShapeSetView& shapes_;
  std::uint8_t* const states_;
  const bool exact_leaves_;
  std::uint32_t size_ = 0, numbered_ = 0;
  std::uint16_t slots_[capacity];  ///< a permutation: first those of undecided pairs, then free ones
  Traversal traversals_[capacity];
  std::uint64_t overlaps_[capacity];
  AncestorPath<Simd> ancestors_a_[verified_together],
      ancestors_b_[verified_together];  ///< of the overlaps that are verified
  PlacedSegments placed_[verified_together];
  SegmentTest<Simd> segments_;
  Frame frames_[capacity][max_frames + 2];
};

}  // namespace bch::detail
