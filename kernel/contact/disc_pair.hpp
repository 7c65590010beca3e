// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch {

/// Two discs that overlap, by their numbers in the cuts of a pair's agents; see cut_discs().
struct DiscPair {
  std::uint32_t first;   ///< of the pair's first agent
  std::uint32_t second;  ///< of its second
  friend bool operator==(const DiscPair&, const DiscPair&) = default;
};

}  // namespace bch
