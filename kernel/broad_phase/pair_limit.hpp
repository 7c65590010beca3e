// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

namespace bch::detail {

/// Returns how many pairs of neighbours are held unless a caller says otherwise: agents that are nearer each other than people can be
/// have more, such as 3 000 at one place.
constexpr std::size_t usual_max_pairs(std::size_t agents) noexcept {
  return 4'000'000 + 100 * agents;
}

}  // namespace bch::detail
