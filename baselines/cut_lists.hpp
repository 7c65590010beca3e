// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/agents.hpp"
#include "layout/shape_set.hpp"

namespace bch::baselines {

/// The discs of every cut that a plan names, in the order of cut(): what references that look at all pairs of discs
/// start from.
class CutLists {
 public:
  CutLists(std::span<const Shape> shapes, const ShapeSetPlan& plan);

  /// Of the agent's shape at its level.
  std::span<const Disc> of(const Agents& agents, std::uint32_t agent) const;
  /// Metres, not below the reach that layout/rounding.hpp speaks of.
  float reach(const Agents& agents, std::uint32_t agent) const;

 private:
  std::size_t level_count_;
  std::vector<std::vector<Disc>> lists_;  ///< shape * level_count_ + level
  std::vector<float> reach_;              ///< per shape, rounded up
};

}  // namespace bch::baselines
