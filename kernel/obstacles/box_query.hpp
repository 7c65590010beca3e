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
  /// Writes the boxes, by their places in the tree, to `found`, at most `room`, depth first, which is no order to rely on.
  /// Returns: how many there are, which may be more.
  static std::uint32_t run(const BoxTreeView& tree, const Box& box, std::uint32_t* found,
                           std::uint32_t room) noexcept {
    if (tree.levels == 0) return 0;
    struct Step {
      std::uint32_t level, block;
    };
    // A step leaves seven brothers behind at most.
    Step steps[7 * most_box_levels + 1];
    std::uint32_t open = 0, count = 0;
    steps[open++] = {tree.levels - 1, 0};
    while (open != 0) {
      const auto [level, block] = steps[--open];
      std::uint32_t hits = overlapping(tree.blocks[tree.level_begin[level] + block], box);
      for (; hits != 0; hits &= hits - 1) {
        const std::uint32_t child = 8 * block + static_cast<std::uint32_t>(__builtin_ctz(hits));
        if (level != 0)
          steps[open++] = {level - 1, child};
        else if (count++ < room)
          found[count - 1] = child;
      }
    }
    return count;
  }

  /// Tests blocks of one level for many queries: writes which boxes of the blocks that `in` names overlap those of the queries, in the order
  /// of `in`. It has no branch that depends on an answer. There has to be room for 8 * (count + 1) hits.
  /// Returns: how many there are.
  static std::uint32_t step(const BoxBlock* blocks, const Box* queries, const BoxHit* in, std::uint32_t count,
                            BoxHit* out) noexcept {
    std::uint32_t size = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const auto [query, block] = in[k];
      const std::uint32_t hits = overlapping(blocks[block], queries[query]);
      for (unsigned i = 0; i < 8; ++i) {
        out[size] = {query, 8 * block + i};
        size += hits >> i & 1;
      }
    }
    return size;
  }

 private:
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
