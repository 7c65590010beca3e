// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::kernel {

/// Some of a chunk's pairs.
template <std::uint32_t capacity>
struct ChunkPairs {
  std::uint32_t size = 0;
  std::uint16_t pair[capacity];

  void add_if(bool wanted, std::uint32_t which) noexcept {
    pair[size] = static_cast<std::uint16_t>(which);
    size += wanted;
  }

  void move_all(ChunkPairs& to) noexcept {
    for (std::uint32_t k = 0; k < size; ++k) to.pair[to.size + k] = pair[k];
    to.size += size;
    size = 0;
  }

  /// Moves the pairs that pass a test to another list. No branch depends on an answer.
  template <class Test>
  void move_if(ChunkPairs& to, Test passes) noexcept {
    std::uint32_t kept = 0, moved = to.size;
    for (std::uint32_t k = 0; k < size; ++k) {
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
