// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/body/band_test.hpp"
#include "kernel/body/placed_bodies.hpp"
#include "kernel/body/sphere_pairs.hpp"

namespace bch::detail {

/// Holds the leaves of two bodies that reach the other one, and B's nodes of these in A's frame, side by side.
template <class Simd>
struct ClippedLeaves {
  using Float = typename Simd::Float;
  using Mask = typename Simd::Mask;
  static constexpr std::uint32_t max_leaves = max_spheres / 4, padding = 16;

  /// Lists the leaves. `reach_a` and `reach_b` hold, for each of `count` pairs of bands, what may take part. Returns whether both have some.
  bool list(const PlacedBodies& bodies, const Reach* reach_a, const Reach* reach_b,
            std::uint32_t count) noexcept {
    const std::uint32_t registers_a = registers(bodies.a), registers_b = registers(bodies.b);
    for (std::uint32_t i = 0; i < registers_a; ++i) kept_a_[i] = 0;
    for (std::uint32_t i = 0; i < registers_b; ++i) kept_b_[i] = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      keep(bodies.a, reach_a[i], registers_a, kept_a_);
      keep(bodies.b, reach_b[i], registers_b, kept_b_);
    }
    rows = list(kept_a_, registers_a, leaf_a);
    columns = list(kept_b_, registers_b, leaf_b);
    return rows != 0 && columns != 0;
  }

  /// Places the nodes of B's leaves that are listed.
  void place_columns(const PlacedBodies& bodies) noexcept {
    const std::uint32_t stride = header_of(bodies.b).node_stride;
    const float dz = bodies.b_in_a.tz;
    for (std::uint32_t i = 0; i < columns; ++i) {
      const float* const node = bodies.b + record_nodes + leaf_b[i];
      const auto at = bodies.b_in_a.ground.apply(node[0], node[stride]);
      x[i] = at.x, y[i] = at.y, radius[i] = node[2 * stride];
      bottom[i] = node[3 * stride] + dz, top[i] = node[4 * stride] + dz;
    }
    for (std::uint32_t i = columns; i < columns + Simd::width; ++i)
      x[i] = __builtin_inff(), y[i] = radius[i] = bottom[i] = top[i] = 0;
  }

  /// Holds a node of A in all lanes.
  struct Node {
    Float x, y, radius, bottom, top;
  };
  static Node node(const float* record, std::uint32_t leaf) noexcept {
    const std::uint32_t stride = header_of(record).node_stride;
    const float* const at = record + record_nodes + leaf;
    return {Float(at[0]), Float(at[stride]), Float(at[2 * stride]), Float(at[3 * stride]),
            Float(at[4 * stride])};
  }

  std::uint32_t rows, columns;  ///< leaves of A, and of B
  std::uint16_t leaf_a[max_leaves + padding], leaf_b[max_leaves + padding];
  /// B's nodes, without a margin. Nodes behind the last one are infinitely far away.
  alignas(64) float x[max_leaves + padding], y[max_leaves + padding], radius[max_leaves + padding],
      bottom[max_leaves + padding], top[max_leaves + padding];

 private:
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
      size += Simd::compress_indices(kept[i], i * Simd::width, leaves + size);
    return size;
  }

  std::uint32_t kept_a_[max_leaves], kept_b_[max_leaves];  ///< bits of registers of nodes
};

}  // namespace bch::detail
