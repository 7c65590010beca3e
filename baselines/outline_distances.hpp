// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <span>

#include "baselines/structure.hpp"
#include "layout/agents.hpp"

namespace bch::baselines {

/// Distances of outlines by somebody else's library: a peer of clearance().
class OutlineDistances {
 public:
  virtual ~OutlineDistances() = default;
  /// Metres; not positive where the outlines cross.
  virtual double query(const Agents& agents, Pair pair) const = 0;
};

/// FCL's distance of trees of oriented boxes and swept spheres over the outlines as walls; null in a build without FCL.
/// Errors:  throws std::invalid_argument on an outline that validate() rejects.
std::unique_ptr<OutlineDistances> fcl_outline_distances(std::span<const Body> bodies);

}  // namespace bch::baselines
