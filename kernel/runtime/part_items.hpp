// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/agents.hpp>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns whether a query has to ask for parts of bodies: where they are cut into slabs, or stand at different heights.
inline bool asks_parts(const ShapeSetView& shapes, const Agents& agents) noexcept {
  return shapes.slab_parts != nullptr || !agents.z.empty();
}

/// Returns the same set with its parts as shapes.
ShapeSetView parts_as_shapes(const ShapeSetView& shapes) noexcept;

/// Holds pairs of parts as pairs of agents of a set whose shapes are parts, for kernels that know nothing of slabs. The items of a pair
/// follow each other, each two parts once; of each the agent of the lower index is that of the pair.
class PartItems {
 public:
  /// Represents an item's pair, and where its parts are: slabs, and the numbers of their first discs among those of their bodies.
  struct Origin {
    std::uint32_t pair;
    std::uint32_t slab_a, slab_b;
    std::uint32_t first_disc_a, first_disc_b;
  };

  /// Finds all parts of pairs that may meet. Everything was validated.
  void expand(const ShapeSetView& shapes, const Agents& agents, std::span<const Pair> pairs);

  std::size_t size() const noexcept { return pairs_.size(); }
  Agents agents() const noexcept { return {part_, x_, y_, heading_, level_}; }
  std::span<const Pair> pairs() const noexcept { return pairs_; }
  const Origin& origin(std::size_t item) const noexcept { return origins_[item]; }
  /// Returns where the items of a pair begin; for the number of pairs, where all end.
  std::size_t begin(std::size_t pair) const noexcept { return begin_[pair]; }

 private:
  void add(const Agents& agents, std::uint32_t agent, std::uint32_t part, std::uint8_t level);

  std::vector<std::uint32_t> part_;
  std::vector<double> x_, y_, heading_;
  std::vector<std::uint8_t> level_;
  std::vector<Pair> pairs_;
  std::vector<Origin> origins_;
  std::vector<std::size_t> begin_;
};

}  // namespace bch::detail
