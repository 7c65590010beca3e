// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include "baselines/quad.hpp"
#include "layout/hierarchy.hpp"

namespace bch::baselines {

/// A disc as it is before anything is rounded outward.
struct ExactDisc {
  QuadVector centre;
  Quad radius = 0;

  /// The same in the axes of the world, about the position of its agent.
  ExactDisc posed(QuadVector rotation) const noexcept { return {turned(rotation, centre), radius}; }
};

/// The tight disc of a node: about the stored centre, which is exact, through the farthest point of what it holds.
/// What the library promises of it: where tight discs of two agents' cuts have a point in common, the answer is a hit.
/// Errors:  throws std::out_of_range where the hierarchy has no elements.
ExactDisc tight_disc(const Hierarchy& hierarchy, std::uint32_t node);

/// Those of a cut, in depth-first order.
std::vector<ExactDisc> tight_discs(const Hierarchy& hierarchy, std::uint32_t depth);

}  // namespace bch::baselines
