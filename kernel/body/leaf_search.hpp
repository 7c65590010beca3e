// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/body/band_test.hpp"
#include "kernel/body/placed_bodies.hpp"
#include "kernel/body/sphere_pairs.hpp"

namespace bch::detail {

/// Decides pairs of bodies by their leaves: clips the nodes of either by what reaches the other one, compares the nodes that are left, and
/// the spheres of those that overlap, a few rows at a time until some overlap.
template <class Simd>
class LeafSearch {
 public:
  /// Returns whether some spheres overlap. `reach_a` and `reach_b` hold, for each of `count` pairs of bands, what may take part.
  bool run(const PlacedBodies& bodies, const Reach* reach_a, const Reach* reach_b,
           std::uint32_t count) noexcept {
    bodies_ = &bodies;
    const std::uint32_t registers_a = registers(bodies.a), registers_b = registers(bodies.b);
    for (std::uint32_t i = 0; i < registers_a; ++i) kept_a_[i] = 0;
    for (std::uint32_t i = 0; i < registers_b; ++i) kept_b_[i] = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      keep(bodies.a, reach_a[i], registers_a, kept_a_);
      keep(bodies.b, reach_b[i], registers_b, kept_b_);
    }
    const std::uint32_t rows = list(kept_a_, registers_a, leaf_a_);
    size_b_ = list(kept_b_, registers_b, leaf_b_);
    if (rows == 0 || size_b_ == 0) return false;
    place_nodes();
    for (std::uint32_t row = 0; row < rows; row += rows_at_once)
      if (compare(row, rows - row < rows_at_once ? rows : row + rows_at_once)) return true;
    return false;
  }

 private:
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;
  static constexpr std::uint32_t most_leaves = most_spheres / 4, padding = 16;
  static constexpr std::uint32_t rows_at_once = 4;

  static std::uint32_t registers(const float* record) noexcept {
    return (header_of(record).leaf_count + Simd::width - 1) / Simd::width;
  }

  /// Adds to the bits of nodes those that reach the other body. No branch depends on a node.
  [[gnu::always_inline]] static void keep(const float* record, const Reach& reach, std::uint32_t registers,
                                          std::uint32_t* kept) noexcept {
    const std::uint32_t stride = header_of(record).node_stride;
    const float* node = record + record_nodes;
    const Float low(reach.low), high(reach.high);
    for (std::uint32_t i = 0; i < registers; ++i, node += Simd::width) {
      const Float x = Simd::load(node), y = Simd::load(node + stride), r = Simd::load(node + 2 * stride);
      const Float bottom = Simd::load(node + 3 * stride), top = Simd::load(node + 4 * stride);
      Mask reaches = (low <= top) & (bottom <= high);
#pragma GCC unroll 3
      for (unsigned axis = 0; axis < Reach::axes; ++axis)
        reaches =
            reaches & (Float(reach.x[axis]) * x + Float(reach.y[axis]) * y - r <= Float(reach.most[axis]));
      kept[i] |= Simd::bits(reaches);
    }
  }

  /// Lists the leaves whose bits are set.
  static std::uint32_t list(const std::uint32_t* kept, std::uint32_t registers,
                            std::uint16_t* leaves) noexcept {
    std::uint32_t size = 0;
    for (std::uint32_t i = 0; i < registers; ++i)
      size += Simd::write_set(kept[i], i * Simd::width, leaves + size);
    return size;
  }

  /// Places the nodes of B that are left, side by side, with the margin.
  void place_nodes() noexcept {
    const std::uint32_t stride = header_of(bodies_->b).node_stride;
    const float margin = bodies_->margin(), rise = bodies_->b_in_a.tz;
    for (std::uint32_t i = 0; i < size_b_; ++i) {
      const float* const node = bodies_->b + record_nodes + leaf_b_[i];
      const auto [x, y] = bodies_->b_in_a.ground.apply(node[0], node[stride]);
      x_[i] = x, y_[i] = y, radius_[i] = node[2 * stride] + margin;
      bottom_[i] = node[3 * stride] + rise - margin, top_[i] = node[4 * stride] + rise + margin;
    }
    for (std::uint32_t i = size_b_; i < size_b_ + Simd::width; ++i)
      x_[i] = __builtin_inff(), y_[i] = radius_[i] = bottom_[i] = top_[i] = 0;
  }

  /// Compares rows begin .. end of A's nodes with B's, then the spheres of the leaves that may meet.
  bool compare(std::uint32_t begin, std::uint32_t end) noexcept {
    const std::uint32_t stride = header_of(bodies_->a).node_stride;
    std::uint32_t size = 0;
    for (std::uint32_t row = begin; row < end; ++row) {
      const float* const node = bodies_->a + record_nodes + leaf_a_[row];
      const Float x(node[0]), y(node[stride]), radius(node[2 * stride]), bottom(node[3 * stride]),
          top(node[4 * stride]);
      for (std::uint32_t k = 0; k < size_b_; k += Simd::width) {
        const Float dx = Simd::load(x_ + k) - x, dy = Simd::load(y_ + k) - y,
                    sum = Simd::load(radius_ + k) + radius;
        const Mask meet = (dx * dx + dy * dy <= sum * sum) & (bottom <= Simd::load(top_ + k)) &
                          (Simd::load(bottom_ + k) <= top);
        size += Simd::write_set(Simd::bits(meet), (row - begin) * most_leaves + k, meeting_ + size);
      }
    }
    for (std::uint32_t i = 0; i < size; ++i)
      if (leaves_overlap(leaf_a_[begin + meeting_[i] / most_leaves], leaf_b_[meeting_[i] % most_leaves]))
        return true;
    return false;
  }

  static Balls leaf(const float* record, std::uint32_t leaf) noexcept {
    const BodyHeader& header = header_of(record);
    const std::size_t size = header.leaf_size;
    return {record + record_nodes + 5 * header.node_stride + 4 * size * leaf, size};
  }

  bool leaves_overlap(std::uint32_t leaf_a, std::uint32_t leaf_b) const noexcept {
    const Balls a = leaf(bodies_->a, leaf_a), b = leaf(bodies_->b, leaf_b);
    if (a.stride + b.stride == 8) [[likely]]
      return balls_overlap<Simd, 4>(bodies_->b_in_a, a, b);
    if (a.stride == 8 && b.stride == 8) return balls_overlap<Simd, 8>(bodies_->b_in_a, a, b);
    for (unsigned i = 0; i < a.stride; i += 4)
      for (unsigned j = 0; j < b.stride; j += 4)
        if (balls_overlap<Simd, 4>(bodies_->b_in_a, a.from(i), b.from(j))) return true;
    return false;
  }

  const PlacedBodies* bodies_ = nullptr;
  std::uint32_t size_b_ = 0;
  std::uint32_t kept_a_[most_leaves], kept_b_[most_leaves];  ///< bits of registers of nodes
  std::uint16_t leaf_a_[most_leaves + padding], leaf_b_[most_leaves + padding];
  /// B's nodes that are left.
  alignas(64) float x_[most_leaves + padding], y_[most_leaves + padding], radius_[most_leaves + padding],
      bottom_[most_leaves + padding], top_[most_leaves + padding];
  /// Pairs of nodes that meet: a row after `begin`, times most_leaves, and the place of one of B's.
  std::uint16_t meeting_[rows_at_once * most_leaves + padding];
};

}  // namespace bch::detail
