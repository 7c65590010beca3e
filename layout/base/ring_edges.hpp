// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

namespace bch::detail {

/// Calls visit(i, next) for every element of every ring and the one that follows it there; the first one follows the last.
/// `ends`: where each ring ends among the elements, ascending.
template <class Visit>
void for_each_ring_edge(std::span<const std::uint32_t> ends, Visit visit) {
  std::uint32_t begin = 0;
  for (const std::uint32_t end : ends) {
    for (std::uint32_t i = begin; i < end; ++i) visit(i, i + 1 < end ? i + 1 : begin);
    begin = end;
  }
}

}  // namespace bch::detail
