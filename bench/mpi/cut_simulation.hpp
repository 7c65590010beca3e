// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include <bch/shape_set.hpp>

#include "bench/mpi/scenery.hpp"

namespace bch::cli {

/// Holds what a rank of a simulated crowd would have to do in a step.
struct SimulatedRank {
  double agents = 0, pairs = 0;
  std::uint64_t halo = 0, sent = 0, migrants = 0;  ///< copies that come and go, agents that leave
  std::set<int> neighbours;
};

/// Represents the bodies of a crowd, as far as the cut is concerned.
struct SimulatedBodies {
  double reach;  ///< the largest radius about an agent's position, metres
  double disc;   ///< the mean radius of the discs that make pairs
};
SimulatedBodies bodies_of(const ShapeSet& set);

/// Cuts a crowd for so many ranks by the densities of its squares, without agents: these are drawn where squares touch others' alone, to
/// count halos and migration by the functions that DistributedCrowd uses.
std::vector<SimulatedRank> simulate_cut(const Scenery& scenery, const SimulatedBodies& bodies, int ranks,
                                        double agent_pairs);

}  // namespace bch::cli
