// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

/// Lists some of a packet's pairs. (`Simd` also keeps instruction sets from sharing a function.)
template <class Simd, std::uint32_t capacity>
struct PacketPairs {
  static constexpr std::uint32_t padding = 16;     ///< lanes of the widest register
  static constexpr std::uint32_t pairs_ahead = 8;  ///< how many pairs ahead `prefetch` is called

  std::uint32_t size = 0;
  std::uint16_t pair[capacity + padding];

  void add_if(bool wanted, std::uint32_t which) noexcept {
    pair[size] = static_cast<std::uint16_t>(which);
    size += wanted;
  }

  /// Adds the pairs first + i whose bits i are set.
  void add(std::uint32_t bits, std::uint32_t first) noexcept {
    size += Simd::compress_indices(bits, first, pair + size);
  }

  /// Empties this list and appends the pairs that fail the test to `rest`, which may be this list. No branch depends on
  /// an answer. `prefetch(pair)` prefetches what the test will read.
  template <class Test, class Prefetch>
  void drop_if(PacketPairs& rest, Test passes, Prefetch prefetch) noexcept {
    const std::uint32_t count = size;
    size = 0;
    std::uint32_t kept = rest.size;
    for (std::uint32_t k = 0; k < count; ++k) {
      if (k + pairs_ahead < count) prefetch(pair[k + pairs_ahead]);
      const std::uint16_t each = pair[k];
      rest.pair[kept] = each;
      kept += passes(each) ^ 1;
    }
    rest.size = kept;
  }
};

}  // namespace bch::detail
