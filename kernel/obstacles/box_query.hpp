// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/obstacles/box_tree.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Finds which boxes of a tree overlap a box, touching included. Eight children are tested at once.
template <class Simd>
class BoxQuery {
 public:
  /// Tests blocks of one level for many queries. Each element of `in` names one block and one query. For each element,
  /// in order, it writes the boxes of that block that overlap the box of that query. No branch depends on an answer.
  /// `out` has room for 8 * count hits.
  /// Returns: how many were written.
  static std::uint32_t run(const BoxBlock* blocks, const Box* queries, const BoxHit* in, std::uint32_t count,
                           BoxHit* out) noexcept {
    std::uint32_t size = 0;
    for (std::uint32_t begin = 0; begin < count; begin += blocks_together) {
      const std::uint32_t left = count - begin;
      size += test(blocks, queries, in + begin, left < blocks_together ? left : blocks_together, out + size);
    }
    return size;
  }

 private:
  static constexpr std::uint32_t blocks_together = 256;

  static std::uint32_t test(const BoxBlock* blocks, const Box* queries, const BoxHit* in, std::uint32_t count,
                            BoxHit* out) noexcept {
    // Eight per block, and what a register writes beyond.
    std::uint16_t found[8 * blocks_together + Simd::width];
    std::uint32_t size = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t bits = overlapping(blocks[in[k].place], queries[in[k].query]);
      for (std::uint32_t i = 0; i < 8; i += Simd::width)
        size += Simd::compress_indices(bits >> i, 8 * k + i, found + size);
    }
    for (std::uint32_t i = 0; i < size; ++i) {
      const auto [query, block] = in[found[i] / 8];
      out[i] = {query, 8 * block + found[i] % 8};
    }
    return size;
  }

  static std::uint32_t overlapping(const BoxBlock& block, const Box& box) noexcept {
    using Double = typename Simd::Double;
    std::uint32_t bits = 0;
    for (unsigned k = 0; k < 8; k += Simd::doubles)
      bits |= Simd::bits((Simd::load(block.low_x + k) <= Double(box.high_x)) &
                         (Simd::load(block.low_y + k) <= Double(box.high_y)) &
                         (Double(box.low_x) <= Simd::load(block.high_x + k)) &
                         (Double(box.low_y) <= Simd::load(block.high_y + k)))
              << k;
    return bits;
  }
};

}  // namespace bch::detail
