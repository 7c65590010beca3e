// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/hierarchy.hpp>

#include "baselines/quad.hpp"

namespace bch::baselines {

/// Represents a disc as it is before anything is rounded outward.
struct ExactDisc {
  QuadVector centre;
  Quad radius = 0;

  /// Returns the disc in the axes of the world, about the position of its agent.
  ExactDisc posed(QuadVector rotation) const noexcept { return {turned(rotation, centre), radius}; }
};

/// Returns the tight disc of a node: about the stored centre, which is exact, through the farthest point of
/// what it holds. What the library promises of it: where a disc of one agent's cut and all discs above have a
/// point in common with a disc of the other's and all above that, each with each, the answer is a hit.
/// Errors:  throws std::out_of_range where the hierarchy has no primitives.
ExactDisc tight_disc(const Hierarchy& hierarchy, std::uint32_t node);

/// Holds the tight discs of a cut and of all nodes above it, in depth-first order: the root is the first.
struct ExactCut {
  std::vector<ExactDisc> discs;
  std::vector<std::uint32_t>
      above;  ///< per disc: the one whose node has its node for a child; of the root, itself
  std::vector<std::uint32_t> cut;  ///< those of the cut, in its order

  /// Returns the cut in the axes of the world, about the position of the agent.
  ExactCut posed(QuadVector rotation) const;
  /// Returns the path from a disc up to the root, both included.
  std::vector<std::uint32_t> path(std::uint32_t disc) const;
};

/// Computes the tight discs of the nodes from the root down to the cut at a depth.
/// Errors:  as tight_disc().
ExactCut exact_cut(const Hierarchy& hierarchy, std::uint32_t depth);

}  // namespace bch::baselines
