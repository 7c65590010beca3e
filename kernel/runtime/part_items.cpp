// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/runtime/part_items.hpp"

#include <algorithm>

#include "kernel/simd/slab_pairs.hpp"
#include "layout/format/parts.hpp"

namespace bch::detail {

ShapeSetView parts_as_shapes(const ShapeSetView& shapes) noexcept {
  ShapeSetView parts = shapes;
  parts.shape_count = shapes.part_count;
  parts.slab_count = 1;
  parts.slab_order = nullptr, parts.slab_parts = nullptr;
  return parts;
}

void PartItems::expand(const ShapeSetView& shapes, const Agents& agents, std::span<const Pair> pairs) {
  part_.clear(), x_.clear(), y_.clear(), heading_.clear(), level_.clear();
  pairs_.clear(), origins_.clear(), begin_.clear();
  const auto level_of = [&](std::uint32_t agent) {
    return static_cast<std::uint8_t>(agents.level.empty() ? shapes.level_count - 1 : agents.level[agent]);
  };
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    begin_.push_back(pairs_.size());
    const auto [a, b] = std::minmax(pairs[i].first, pairs[i].second);
    const double rise = agents.z.empty() ? 0 : agents.z[b] - agents.z[a];
    const SlabPairs<void> slab_pairs(shapes, agents.shape[a], agents.shape[b], rise);
    const std::uint8_t level_a = level_of(a), level_b = level_of(b);
    std::uint32_t cursor = 0;
    for (auto parts = slab_pairs.next(cursor); parts.a != no_part; parts = slab_pairs.next(cursor)) {
      const auto first = static_cast<std::uint32_t>(part_.size());
      add(agents, a, parts.a, level_a), add(agents, b, parts.b, level_b);
      pairs_.push_back({first, first + 1});
      origins_.push_back({i, parts.slab_a, parts.slab_b,
                          first_disc(shapes, agents.shape[a], parts.a, level_a),
                          first_disc(shapes, agents.shape[b], parts.b, level_b)});
    }
  }
  begin_.push_back(pairs_.size());
}

void PartItems::add(const Agents& agents, std::uint32_t agent, std::uint32_t part, std::uint8_t level) {
  part_.push_back(part);
  x_.push_back(agents.x[agent]), y_.push_back(agents.y[agent]), heading_.push_back(agents.heading[agent]);
  level_.push_back(level);
}

}  // namespace bch::detail
