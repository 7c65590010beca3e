// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/distance/time_of_impact_measure.hpp"
#include "kernel/simd/disc_pairs.hpp"
#include "kernel/simd/packet_pairs.hpp"
#include "kernel/simd/transform.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Implements the last stage of TimeOfImpactKernel: branch and bound over the trees of many pairs of agents,
/// in rounds. A round advances every open pair by one step. The stages of a step depend on each other, so
/// each stage is done for all pairs before the next, which overlaps the latencies of many pairs:
///
/// 1. bounds of the discs of two nodes;
/// 2. the least of these bounds;
/// 3. descent to the two children with the least bound; or, if both nodes are leaf blocks (leaves of eight
///    consecutive discs), the time of the two discs with the least bound;
/// 4. if nothing is left below two nodes, back to the previous two nodes.
///
/// Hardly any branch depends on data.
template <class Simd>
class TimeOfImpactTraversal {
 public:
  using Measure = TimeOfImpactMeasure<Simd>;
  static constexpr std::uint32_t capacity = 32;

  TimeOfImpactTraversal(const float* nodes, float* times) noexcept : nodes_(nodes), times_(times) {}

  /// Adds a pair whose time goes to times[pair]. Runs rounds first if there is no room.
  void add(std::size_t pair, const Transform& b_in_a, const Tree& a, const Tree& b,
           const Measure& measure) noexcept {
    // Only a quarter of the pairs is finished at a time, so that rounds keep many pairs.
    if (fresh_.size + returning_.size == capacity) run(capacity - capacity / 4);
    // Slots are numbered on first use, because small batches need few.
    if (free_.size == 0) free_.add_if(true, numbered_++);
    const std::uint16_t slot = free_.pair[--free_.size];
    open_[slot] = {b_in_a,        measure,       a.top, b.top, a.stride, b.stride,
                   frames_[slot], frames_[slot], pair,  0,     0};
    fresh_.add_if(true, slot);
  }

  /// Runs rounds until at most `max_open` pairs are open.
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
  using Slots = PacketPairs<Simd, capacity>;
  /// The depth of a pair's stack: every step descends in at least one tree, and no tree has more than
  /// max_wide_levels levels.
  static constexpr std::uint32_t max_frames = 2 * max_wide_levels;

  /// Holds two nodes and the bounds of their pairs of discs; far_beyond for pairs already visited.
  struct Frame {
    alignas(64) float bound[block_pairs];
    std::uint32_t a, b;
  };

  struct Open {
    Transform b_in_a;
    Measure measure;
    std::uint32_t a, b;  ///< the nodes to examine
    std::uint32_t stride_a, stride_b;
    Frame *frame, *bottom;  ///< the frame of these nodes, and the first frame of the pair
    std::size_t pair;
    float least;          ///< the least bound in the frame
    std::uint32_t which;  ///< the pair of discs with that bound
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

  /// Assigns each open pair to its next step. `fresh_` then lists the pairs that descend.
  void choose() noexcept {
    Slots below;
    leaf_blocks_.size = missed_.size = 0;
    for (std::uint32_t k = 0; k < fresh_.size; ++k) {
      const Open& open = open_[fresh_.pair[k]];
      const bool hit = open.least <= open.measure.limit(), leaf_blocks = (open.a & open.b) >= leaf_bit;
      below.add_if(hit & !leaf_blocks, fresh_.pair[k]);
      leaf_blocks_.add_if(hit & leaf_blocks, fresh_.pair[k]);
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

  /// Descends to the children with the least bound.
  void descend(Open& open) const noexcept {
    Frame& frame = *open.frame++;
    const unsigned i = open.which / block_width, j = open.which % block_width;
    const auto close = [&frame](unsigned first, unsigned apart) {
      for (unsigned k = 0; k < block_width; ++k) frame.bound[first + k * apart] = far_beyond;
    };
    open.a = child(frame.a, i), open.b = child(frame.b, j);
    frame.bound[open.which] = far_beyond;
    // A leaf block has no children. If one of the two nodes is a leaf block, the next visit tests the child of the other
    // node with all eight discs of the leaf block. So no other pair of that child and a disc of the leaf block is
    // visited: the bounds of these pairs are closed.
    if (frame.a >= leaf_bit) [[unlikely]]
      close(j, block_width);
    if (frame.b >= leaf_bit) [[unlikely]]
      close(i * block_width, 1);
  }

  /// Returns the child of a node in a lane; a leaf block is its own child.
  std::uint32_t child(std::uint32_t node, unsigned lane) const noexcept {
    return node >= leaf_bit ? node : Nodes::child(nodes_, node, lane);
  }

  /// Computes the time of impact of the two discs with the least bound, for each pair at two leaf blocks. This time
  /// usually excludes all other discs of the two leaf blocks.
  void update_times() noexcept {
    for (std::uint32_t k = 0; k < leaf_blocks_.size; ++k) {
      const Open& open = open_[leaf_blocks_.pair[k]];
      const auto [x, y, r] = disc_pair<Simd>(open.b_in_a, discs_a(open), discs_b(open), open.which);
      x_[k] = x, y_[k] = y, r_[k] = r;
      displacement_x_[k] = open.measure.x(), displacement_y_[k] = open.measure.y();
    }
    for (std::uint32_t k = 0; k < leaf_blocks_.size; k += Simd::doubles)
      Simd::store(time_ + k, Measure::template time_of<Double>(
                                 Simd::load(x_ + k), Simd::load(y_ + k), Simd::load(r_ + k),
                                 Simd::load(displacement_x_ + k), Simd::load(displacement_y_ + k)));
    for (std::uint32_t k = 0; k < leaf_blocks_.size; ++k) {
      Open& open = open_[leaf_blocks_.pair[k]];
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

  /// Returns two kinds of pairs of agents to their previous nodes: those without useful bounds, and those at two
  /// leaf blocks, because nothing is below leaf blocks.
  void ascend() noexcept {
    for (std::uint32_t k = 0; k < leaf_blocks_.size; ++k) missed_.add_if(true, leaf_blocks_.pair[k]);
    returning_.size = 0;
    for (std::uint32_t k = 0; k < missed_.size; ++k) {
      const std::uint16_t slot = missed_.pair[k];
      Open& open = open_[slot];
      const bool over = open.frame == open.bottom;
      open.frame -= !over;
      // This is final for pairs whose search is over. The others write it again.
      times_[open.pair] = open.measure.time();
      returning_.add_if(!over, slot);
      free_.add_if(over, slot);
    }
  }

  const float* const nodes_;
  float* const times_;
  // Slots of pairs of agents. fresh_: those at new nodes. returning_: those back at previous nodes. free_:
  // unused. In the current round, windows_: those at two leaf blocks. missed_: those with nothing left below
  // their nodes.
  Slots fresh_, returning_, free_;
  Slots leaf_blocks_, missed_;
  std::uint32_t numbered_ = 0;
  alignas(64) double x_[capacity] = {}, y_[capacity] = {}, r_[capacity] = {};
  double displacement_x_[capacity] = {}, displacement_y_[capacity] = {}, time_[capacity];
  Open open_[capacity];
  Frame frames_[capacity][max_frames + 1];
};

}  // namespace bch::detail
