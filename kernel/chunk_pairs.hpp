// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::kernel {

/// Some of a chunk's pairs. (`Simd` also keeps instruction sets from sharing a function.)
template <class Simd, std::uint32_t capacity>
struct ChunkPairs {
  static constexpr std::uint32_t padding = 16;     ///< lanes of the widest register
  static constexpr std::uint32_t pairs_ahead = 8;  ///< that `prefetch` is called for

  std::uint32_t size = 0;
  std::uint16_t pair[capacity + padding];

  void add_if(bool wanted, std::uint32_t which) noexcept {
    pair[size] = static_cast<std::uint16_t>(which);
    size += wanted;
  }

  /// Those of the pairs from `first` on whose bits are set.
  void add(std::uint32_t bits, std::uint32_t first) noexcept {
    size += Simd::write_set(bits, first, pair + size);
  }

  void move_all(ChunkPairs& to) noexcept {
    for (std::uint32_t k = 0; k < size; ++k) to.pair[to.size + k] = pair[k];
    to.size += size;
    size = 0;
  }

  /// Forgets the pairs that pass a test. No branch depends on an answer, here and below.
  template <class Test>
  void drop_if(Test passes) noexcept {
    std::uint32_t kept = 0;
    for (std::uint32_t k = 0; k < size; ++k) {
      const std::uint16_t each = pair[k];
      pair[kept] = each;
      kept += passes(each) ^ 1;
    }
    size = kept;
  }

  /// Moves the pairs that pass a test to another list. `prefetch(pair)` asks for what the test will read.
  template <class Test, class Prefetch>
  void move_if(ChunkPairs& to, Test passes, Prefetch prefetch) noexcept {
    std::uint32_t kept = 0, moved = to.size;
    for (std::uint32_t k = 0; k < size; ++k) {
      if (k + pairs_ahead < size) prefetch(pair[k + pairs_ahead]);
      const std::uint16_t each = pair[k];
      const std::uint32_t yes = passes(each);
      pair[kept] = to.pair[moved] = each;
      kept += yes ^ 1;
      moved += yes;
    }
    size = kept;
    to.size = moved;
  }
};

}  // namespace bch::kernel
