// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/body/clipped_leaves.hpp"
#include "kernel/body/placed_bodies.hpp"
#include "kernel/body/sphere_pairs.hpp"

namespace bch::detail {

/// Decides pairs of bodies by their leaves: clips the nodes of either by what reaches the other one, compares the nodes that are left, and
/// the spheres of those that meet, a few rows at a time until some do.
template <class Simd>
class LeafSearch {
 public:
  /// Returns whether some spheres meet. `reach_a` and `reach_b` are as for ClippedLeaves::list().
  bool run(const PlacedBodies& bodies, const Reach* reach_a, const Reach* reach_b,
           std::uint32_t count) noexcept {
    if (!leaves_.list(bodies, reach_a, reach_b, count)) return false;
    leaves_.place_columns(bodies);
    for (std::uint32_t row = 0; row < leaves_.rows; row += rows_at_once)
      if (compare(bodies, row, leaves_.rows - row < rows_at_once ? leaves_.rows : row + rows_at_once))
        return true;
    return false;
  }

 private:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;
  static constexpr std::uint32_t max_leaves = ClippedLeaves<Simd>::max_leaves;
  static constexpr std::uint32_t rows_at_once = 4;

  /// Compares rows begin .. end of A's nodes with B's, then the spheres of the leaves that may meet.
  bool compare(const PlacedBodies& bodies, std::uint32_t begin, std::uint32_t end) noexcept {
    const Float margin(bodies.margin());
    std::uint32_t size = 0;
    for (std::uint32_t row = begin; row < end; ++row) {
      auto node = leaves_.node(bodies.a, leaves_.leaf_a[row]);
      node.radius = node.radius + margin, node.bottom = node.bottom - margin, node.top = node.top + margin;
      for (std::uint32_t k = 0; k < leaves_.columns; k += Simd::width) {
        const Float dx = Simd::load(leaves_.x + k) - node.x, dy = Simd::load(leaves_.y + k) - node.y,
                    sum = Simd::load(leaves_.radius + k) + node.radius;
        const Mask meet = (dx * dx + dy * dy <= sum * sum) & (node.bottom <= Simd::load(leaves_.top + k)) &
                          (Simd::load(leaves_.bottom + k) <= node.top);
        size += Simd::compress_indices(Simd::bits(meet), (row - begin) * max_leaves + k, meeting_ + size);
      }
    }
    for (std::uint32_t i = 0; i < size; ++i)
      if (leaves_meet(bodies, leaves_.leaf_a[begin + meeting_[i] / max_leaves],
                      leaves_.leaf_b[meeting_[i] % max_leaves]))
        return true;
    return false;
  }

  static bool leaves_meet(const PlacedBodies& bodies, std::uint32_t leaf_a, std::uint32_t leaf_b) noexcept {
    const Balls a = balls_of(bodies.a, leaf_a), b = balls_of(bodies.b, leaf_b);
    return visit_blocks(a, b, [&]<unsigned count>(unsigned i, unsigned j) {
      return balls_meet<Simd, count>(bodies.b_in_a, a.from(i), b.from(j), bodies.gap);
    });
  }

  ClippedLeaves<Simd> leaves_;
  /// Pairs of nodes that meet: a row after `begin`, times max_leaves, and the place of one of B's.
  std::uint16_t meeting_[rows_at_once * max_leaves + ClippedLeaves<Simd>::padding];
};

}  // namespace bch::detail
