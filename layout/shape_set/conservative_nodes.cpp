// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/conservative_nodes.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "layout/base/rounding.hpp"

namespace bch::detail {

bool conservative_nodes(const CutDiscs& discs, std::span<const InnerNode> inner, double max_extent) noexcept {
  if (discs.count == 1) return true;
  const auto holds = [&](const InnerNode& node, std::size_t disc) {
    const double x = double{discs.x[disc]} - double{node.x}, y = double{discs.y[disc]} - double{node.y};
    return std::sqrt(x * x + y * y) + double{discs.radius[disc]} +
               rounding::conservative_margin * max_extent <=
           double{node.radius};
  };
  for (std::uint32_t disc = 0; disc < discs.count; ++disc) {
    std::uint32_t node = disc - (inner[disc].link < parent_of_cut_disc), next = node;
    do {
      node = next;
      if (!holds(inner[node], disc)) return false;
      next = inner[node].link & ~parent_of_cut_disc;
    } while (next != node);
  }
  return true;
}

}  // namespace bch::detail
