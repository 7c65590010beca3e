// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/agents.hpp>
#include <bch/shapes.hpp>

#include "baselines/placement.hpp"

namespace bch::baselines {

/// Holds the discs of one cut, in the order of cut(), each with all discs above it.
struct CutList {
  std::vector<Disc> discs;
  std::vector<std::uint32_t> nodes;  ///< per disc: that of the hierarchy
  std::vector<Disc> paths;  ///< one after the other: from a disc of the cut to the root, both included
  std::vector<std::uint32_t> path_begin;  ///< per disc; then paths.size()

  std::span<const Disc> path(std::size_t disc) const {
    return std::span(paths).subspan(path_begin[disc], path_begin[disc + 1] - path_begin[disc]);
  }
};

/// Returns the answer by its definition: whether some disc of one cut overlaps one of the other, and so do
/// all discs above them. `place` is that of B's agent, seen from A's.
bool any_hit(const FloatPlacement& place, const CutList& a, const CutList& b);

/// Holds the discs of every cut that a plan names: what references that examine all pairs of discs start
/// from.
class CutLists {
 public:
  CutLists(std::span<const Shape> shapes, const ShapeSetPlan& plan);

  /// Returns the cut list of the agent's shape at its level.
  const CutList& list(const Agents& agents, std::uint32_t agent) const;
  /// Returns the discs of that list.
  std::span<const Disc> of(const Agents& agents, std::uint32_t agent) const;
  /// Returns the agent's extent in metres, not below the one that layout/base/rounding.hpp defines.
  float max_extent(const Agents& agents, std::uint32_t agent) const;

 private:
  std::size_t level_count_;
  std::vector<CutList> lists_;     ///< shape * level_count_ + level
  std::vector<float> max_extent_;  ///< per shape, rounded up
};

/// Returns the answer of any_hit() for the cuts of a pair of agents, whatever their order.
bool any_hit(const CutLists& cuts, const Agents& agents, Pair pair);

}  // namespace bch::baselines
