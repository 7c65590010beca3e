// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/distance/time_of_impact_measure.hpp"
#include "kernel/simd/chunk_pairs.hpp"
#include "kernel/simd/disc_pairs.hpp"
#include "kernel/simd/transform.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Implements the last stage of TimeOfImpactKernel: branch and bound over the trees of many pairs of agents, in rounds.
/// A round takes one step of every open pair, stage by stage, because a step of one pair is a chain of
/// latencies, of which the processor looks ahead over few: bounds of two nodes' discs; the least of them;
/// where that leads, the children below it or, of two windows, a time; and back to an earlier pair of nodes
/// where nothing is left to find. Hardly any branch depends on an answer.
template <class Simd>
class TimeOfImpactTraversal {
 public:
  using Measure = TimeOfImpactMeasure<Simd>;
  static constexpr std::uint32_t capacity = 32;

  TimeOfImpactTraversal(const float* nodes, float* times) noexcept : nodes_(nodes), times_(times) {}

  /// Adds a pair whose time goes to times[pair]. Where there is no room, runs rounds until there is.
  void add(std::size_t pair, const Transform& b_in_a, const Tree& a, const Tree& b,
           const Measure& measure) noexcept {
    // Few at a time, so that rounds stay long.
    if (fresh_.size + returning_.size == capacity) run(capacity - capacity / 4);
    // Slots are numbered when they are first needed, because small batches need few.
    if (free_.size == 0) free_.add_if(true, numbered_++);
    const std::uint16_t slot = free_.pair[--free_.size];
    open_[slot] = {b_in_a,        measure,       a.top, b.top, a.stride, b.stride,
                   frames_[slot], frames_[slot], pair,  0,     0};
    fresh_.add_if(true, slot);
  }

  /// Runs rounds until at most so many pairs are open.
  void run(std::uint32_t max_open) noexcept {
    while (fresh_.size + returning_.size > max_open) {
      bound();
      find_least(fresh_);
      find_least(returning_);
      choose();
      for (std::uint32_t k = 0; k < fresh_.size; ++k) descend(open_[fresh_.pair[k]]);
      update_times();
      ascend();
    }
  }

 private:
  using Float = typename Simd::Float;
  using Double = typename Simd::Double;
  using Nodes = TreeNodes<Simd>;
  using Slots = ChunkPairs<Simd, capacity>;
  /// The most frames of a pair: every step descends on one side at least, and no tree has more than
  /// max_wide_levels levels.
  static constexpr std::uint32_t max_frames = 2 * max_wide_levels;

  /// Holds two nodes and the bounds of their pairs of discs, far_beyond where they were followed.
  struct Frame {
    alignas(64) float bound[block_pairs];
    std::uint32_t a, b;
  };

  struct Open {
    Transform b_in_a;
    Measure measure;
    std::uint32_t a, b;  ///< the nodes to examine
    std::uint32_t stride_a, stride_b;
    Frame *frame, *bottom;  ///< of these nodes, and the first
    std::size_t pair;
    float least;          ///< bound in the frame
    std::uint32_t which;  ///< pair of discs has it
  };

  Discs discs_a(const Open& open) const noexcept { return Nodes::outer_discs(nodes_, open.a, open.stride_a); }
  Discs discs_b(const Open& open) const noexcept { return Nodes::outer_discs(nodes_, open.b, open.stride_b); }

  void bound() noexcept {
    for (std::uint32_t k = 0; k < fresh_.size; ++k) {
      const Open& open = open_[fresh_.pair[k]];
      Frame& frame = *open.frame;
      frame.a = open.a, frame.b = open.b;
      open.measure.visit_bounds(open.b_in_a, discs_a(open), discs_b(open),
                                [&frame](unsigned i, Float bound) { Simd::store(frame.bound + i, bound); });
    }
  }

  void find_least(const Slots& slots) noexcept {
    for (std::uint32_t k = 0; k < slots.size; ++k) {
      Open& open = open_[slots.pair[k]];
      const float* const bound = open.frame->bound;
      open.least = least_value<Simd>(bound);
      open.which = first_within<Simd>(bound, open.least);
    }
  }

  /// Sorts the open pairs by their next step. Fresh pairs are then those that descend.
  void choose() noexcept {
    Slots below;
    windows_.size = missed_.size = 0;
    for (std::uint32_t k = 0; k < fresh_.size; ++k) {
      const Open& open = open_[fresh_.pair[k]];
      const bool hit = open.least <= open.measure.limit(), windows = (open.a & open.b) >= leaf_window;
      below.add_if(hit & !windows, fresh_.pair[k]);
      windows_.add_if(hit & windows, fresh_.pair[k]);
      missed_.add_if(!hit, fresh_.pair[k]);
    }
    for (std::uint32_t k = 0; k < returning_.size; ++k) {
      const Open& open = open_[returning_.pair[k]];
      const bool hit = open.least <= open.measure.limit();
      below.add_if(hit, returning_.pair[k]);
      missed_.add_if(!hit, returning_.pair[k]);
    }
    fresh_ = below;
  }

  /// Descends to the children below the least bound.
  void descend(Open& open) const noexcept {
    Frame& frame = *open.frame++;
    const unsigned i = open.which / block_width, j = open.which % block_width;
    const auto close = [&frame](unsigned first, unsigned apart) {
      for (unsigned k = 0; k < block_width; ++k) frame.bound[first + k * apart] = far_beyond;
    };
    open.a = child(frame.a, i), open.b = child(frame.b, j);
    frame.bound[open.which] = far_beyond;
    // All of a window's discs are tested at once: its other pairs with the same child are settled with this
    // one.
    if (frame.a >= leaf_window) [[unlikely]]
      close(j, block_width);
    if (frame.b >= leaf_window) [[unlikely]]
      close(i * block_width, 1);
  }

  /// Returns the child of a node in a lane; a window is its own child.
  std::uint32_t child(std::uint32_t node, unsigned lane) const noexcept {
    return node >= leaf_window ? node : Nodes::child(nodes_, node, lane);
  }

  /// Takes the times of the disc pairs with the least bounds, which mostly exclude all others.
  void update_times() noexcept {
    for (std::uint32_t k = 0; k < windows_.size; ++k) {
      const Open& open = open_[windows_.pair[k]];
      const auto [x, y, r] = disc_pair<Simd>(open.b_in_a, discs_a(open), discs_b(open), open.which);
      x_[k] = x, y_[k] = y, r_[k] = r;
      displacement_x_[k] = open.measure.x(), displacement_y_[k] = open.measure.y();
    }
    for (std::uint32_t k = 0; k < windows_.size; k += Simd::doubles)
      Simd::store(time_ + k, Measure::template time_of<Double>(
                                 Simd::load(x_ + k), Simd::load(y_ + k), Simd::load(r_ + k),
                                 Simd::load(displacement_x_ + k), Simd::load(displacement_y_ + k)));
    for (std::uint32_t k = 0; k < windows_.size; ++k) {
      Open& open = open_[windows_.pair[k]];
      open.measure.update(time_[k]);
      const std::uint64_t others =
          all_within<Simd>(open.frame->bound, open.measure.limit()) & ~(std::uint64_t{1} << open.which);
      if (others != 0) [[unlikely]]
        update_from_others(open, others);
    }
  }

  void update_from_others(Open& open, std::uint64_t others) const noexcept {
    for (; others != 0; others &= others - 1) {
      const auto k = static_cast<unsigned>(__builtin_ctzll(others));
      if (!(open.frame->bound[k] <= open.measure.limit())) continue;
      const auto [x, y, r] = disc_pair<Simd>(open.b_in_a, discs_a(open), discs_b(open), k);
      open.measure.update(Measure::template time_of<double>(x, y, r, open.measure.x(), open.measure.y()));
    }
  }

  /// Takes back the pairs that missed and those with windows, whose bounds are then settled.
  void ascend() noexcept {
    for (std::uint32_t k = 0; k < windows_.size; ++k) missed_.add_if(true, windows_.pair[k]);
    returning_.size = 0;
    for (std::uint32_t k = 0; k < missed_.size; ++k) {
      const std::uint16_t slot = missed_.pair[k];
      Open& open = open_[slot];
      const bool over = open.frame == open.bottom;
      open.frame -= !over;
      // Those that are not over write a later one.
      times_[open.pair] = open.measure.time();
      returning_.add_if(!over, slot);
      free_.add_if(over, slot);
    }
  }

  const float* const nodes_;
  float* const times_;
  // Pairs of agents by their slots: whose nodes are new; who goes on with nodes from before; and for the
  // round who is at two windows, and who finds nothing below the nodes.
  Slots fresh_, returning_, free_;
  Slots windows_, missed_;
  std::uint32_t numbered_ = 0;
  alignas(64) double x_[capacity] = {}, y_[capacity] = {}, r_[capacity] = {};
  double displacement_x_[capacity] = {}, displacement_y_[capacity] = {}, time_[capacity];
  Open open_[capacity];
  Frame frames_[capacity][max_frames + 1];
};

}  // namespace bch::detail
