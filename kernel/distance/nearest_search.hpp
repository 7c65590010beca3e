// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/distance/best_first_traversal.hpp"
#include "kernel/simd/disc_pairs.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Does the search of BestFirstTraversal for many pairs of agents side by side, so that latencies and cache
/// misses of many pairs overlap. A measure also has
///
///     Mask may_improve(Float x, Float y, Float r)   false only if no discs below have a value up to best()
///
/// 1. Every pair descends to its first leaves, always to the children with the least bound, and keeps the
///    bounds on the way. One round advances each pair by a level.
///    (A measure that probes has measured only a part of these until end_probe().)
/// 2. The best value is then close to the final one, so the order of the remaining nodes hardly matters: they
///    are visited without sorting, which would cost more than it saves.
template <class Simd, class Measure>
class NearestSearch {
 public:
  static constexpr std::uint32_t capacity = 32;

  explicit NearestSearch(const float* nodes) noexcept : traversal_(nodes) {}

  std::uint32_t size() const noexcept { return size_; }
  Measure& measure(std::uint32_t pair) noexcept { return pairs_[pair].measure; }

  /// Adds a pair; size() must be less than capacity.
  void add(const Transform& b_in_a, const Tree& a, const Tree& b, const Measure& measure) noexcept {
    steps_[size_] = {size_, a.top, b.top};
    pairs_[size_] = {measure, b_in_a, a.stride, b.stride, 0};
    ++size_;
  }

  /// Searches all pairs; their measures then hold the answers. Calls between() when each pair has reached its
  /// first leaves; between() may end() searches.
  template <class Between>
  void run(Between between) noexcept {
    descend();
    between();
    inner_.size = 0;
    for (Step step{0, 0, 0}; step.pair < size_; ++step.pair)
      if (pairs_[step.pair].measure.end_probe(step.a, step.b)) measure_leaf_blocks(step);
    for (std::uint32_t depth = max_kept; depth-- > 0;) {
      for (std::uint32_t pair = 0; pair < size_; ++pair)
        if (depth < pairs_[pair].frames) collect(pair, frames_[pair][depth]);
      expand_inner();
    }
  }

  /// Ends the search of a pair whose measure holds the answer.
  void end(std::uint32_t pair) noexcept {
    Step step;
    pairs_[pair].measure.end_probe(step.a, step.b);
    pairs_[pair].frames = 0;
  }

  void clear() noexcept { size_ = 0; }

 private:
  using Float = typename Simd::Float;
  using Frame = NodePairBounds;
  static constexpr std::uint32_t max_kept =
      2;  ///< levels of a descent whose bounds are kept; below these, everything is traversed at once
  static constexpr std::uint32_t list_capacity = 1024;

  /// Holds a pair of agents.
  struct Searched {
    Measure measure;
    Transform at;
    std::uint32_t stride_a, stride_b;
    std::uint32_t frames;
  };

  /// Holds two nodes to visit, of a pair of agents.
  struct Step {
    std::uint32_t pair, a, b;
  };

  struct List {
    std::uint32_t size = 0;
    Step step[list_capacity];
  };

  /// Descends in rounds: bounds of two blocks for every pair, then the next step for every pair.
  void descend() noexcept {
    std::uint32_t open = size_;
    for (std::uint32_t depth = 0; open != 0; ++depth) {
      std::uint32_t left = 0;
      for (std::uint32_t k = 0; k < open; ++k) {
        const Step step = steps_[k];
        Searched& pair = pairs_[step.pair];
        if ((step.a & step.b) >= leaf_bit) {
          measure_leaf_blocks(step);
        } else if (depth == max_kept) {
          traversal_.run(pair.at, step.a, step.b, pair.stride_a, pair.stride_b, pair.measure);
        } else {
          traversal_.bound(pair.at, step.a, step.b, pair.stride_a, pair.stride_b, pair.measure,
                           frames_[step.pair][depth]);
          pair.frames = depth + 1;
          steps_[left++] = step;
        }
      }
      open = 0;
      for (std::uint32_t k = 0; k < left; ++k) {
        const std::uint32_t pair = steps_[k].pair;
        steps_[open].pair = pair;
        open += traversal_.extract_least(frames_[pair][depth], pairs_[pair].measure.best(), steps_[open].a,
                                         steps_[open].b);
      }
    }
  }

  /// Adds the unvisited children of two nodes that may still improve on the best.
  void collect(std::uint32_t pair, const Frame& frame) noexcept {
    add_children({pair, frame.a, frame.b},
                 all_within<Simd>(frame.bound, pairs_[pair].measure.best()) & frame.open);
  }

  /// Adds the pairs of children whose bits are set.
  void add_children(const Step& step, std::uint64_t bits) noexcept {
    // A leaf block is visited as a whole, once with each child of the other node.
    if (step.a >= leaf_bit) bits = fold(bits, 8) & first_row_of_pairs;
    if (step.b >= leaf_bit) bits = fold(bits, 1) & first_column_of_pairs;
    for (; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<unsigned>(__builtin_ctzll(bits));
      const Step child{step.pair, traversal_.child(step.a, k / block_width),
                       traversal_.child(step.b, k % block_width)};
      if ((child.a & child.b) >= leaf_bit)
        visit_leaf_block(child);
      else if (inner_.size < list_capacity)
        inner_.step[inner_.size++] = child;
      else
        traverse(child);
    }
  }

  /// Combines, by "or", eight bits at a distance of `apart` into the first of them.
  static std::uint64_t fold(std::uint64_t bits, unsigned apart) noexcept {
    for (unsigned far = 4 * apart; far >= apart; far /= 2) bits |= bits >> far;
    return bits;
  }

  void expand_inner() noexcept {
    while (inner_.size != 0) {
      const Step step = inner_.step[--inner_.size];
      add_children(step, improving(step));
    }
  }

  /// Measures the discs of two leaf blocks only if some may improve on the best, which few do. Each improvement
  /// excludes many of the following leaf blocks.
  void visit_leaf_block(const Step& step) noexcept {
    if (improving(step) != 0) measure_leaf_blocks(step);
  }

  /// Returns the bits of the pairs of discs that may improve on the best value.
  [[gnu::always_inline]] std::uint64_t improving(const Step& step) const noexcept {
    const Searched& pair = pairs_[step.pair];
    std::uint64_t bits = 0;
    visit_disc_pairs<Simd>(pair.at, traversal_.outer_discs(step.a, pair.stride_a),
                           traversal_.outer_discs(step.b, pair.stride_b),
                           [&](unsigned k, Float x, Float y, Float r) {
                             bits |= std::uint64_t{Simd::bits(pair.measure.may_improve(x, y, r))} << k;
                           });
    return bits;
  }

  [[gnu::always_inline]] void measure_leaf_blocks(const Step& step) noexcept {
    Searched& pair = pairs_[step.pair];
    traversal_.measure_leaf_blocks(pair.at, step.a, step.b, pair.stride_a, pair.stride_b, pair.measure);
  }

  void traverse(const Step& step) noexcept {
    Searched& pair = pairs_[step.pair];
    traversal_.run(pair.at, step.a, step.b, pair.stride_a, pair.stride_b, pair.measure);
  }

  std::uint32_t size_ = 0;
  Step steps_[capacity];
  Searched pairs_[capacity];
  Frame frames_[capacity][max_kept];
  List inner_;
  BestFirstTraversal<Simd, Measure> traversal_;
};

}  // namespace bch::detail
