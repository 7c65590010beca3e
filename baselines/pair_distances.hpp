// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <span>

#include <bch/agents.hpp>

#include "baselines/structure.hpp"

namespace bch::baselines {

/// Measures distances by another library: a peer of clearance(), and what errors are measured by. Any number
/// of threads may ask.
class PairDistances {
 public:
  virtual ~PairDistances() = default;
  /// Returns the distance in metres; not positive where the two meet. Agents::z counts where triangles are in space.
  virtual double query(const Agents& agents, Pair pair) const = 0;
};

/// Return FCL's distances over the outlines as walls, over one upright triangle a segment, or over the
/// triangles in space, by trees of oriented boxes and swept spheres; null in a build without FCL.
/// Errors:  throw std::invalid_argument on an outline that validate() rejects, on triangles that a Structure
///          would.
std::unique_ptr<PairDistances> fcl_outline_distances(std::span<const Body> bodies);
std::unique_ptr<PairDistances> fcl_segment_distances(std::span<const Body> bodies);
std::unique_ptr<PairDistances> fcl_mesh_distances(std::span<const Body> bodies);

}  // namespace bch::baselines
