// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

namespace bch::detail {

/// Returns the default limit of the number of pairs of neighbours. Only agents closer together than people
/// can be exceed it, such as 3 000 at one position.
constexpr std::size_t usual_max_pairs(std::size_t agents) noexcept {
  return 4'000'000 + 100 * agents;
}

}  // namespace bch::detail
