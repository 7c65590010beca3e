// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/crowd.hpp>

#include "kernel/crowd/separation_solver.hpp"

namespace bch::detail {

struct CrowdMemory;

/// Holds the positions of agents during resolve(), and the memory of its sweeps.
struct Resolution {
  std::vector<double> x, y, first_x, first_y;
  std::vector<double> turn;                  ///< radians, since the beginning; empty if agents may not turn
  std::vector<double> heading_x, heading_y;  ///< of the agents, who may turn
  std::vector<Penetration::Touch> touches;   ///< of the pairs that collide, if agents may turn
  SeparationSolver solver;
  std::vector<float> wall_distance;            ///< of each agent
  std::vector<Vec3> wall_direction;            ///< of each agent
  std::vector<std::uint32_t> agents_at_walls;  ///< agents

  void begin(const Agents& agents, bool may_turn);
  /// Moves all agents by the solver's displacements, within the limits of the options.
  void move(const Crowd::ResolveOptions& options);
  /// Computes the headings, by the agents' own and by how far they have turned.
  void set_headings(const Headings& headings);
};

/// Implements Crowd::resolve().
Crowd::Resolved resolve(CrowdMemory& memory, const BodySet& bodies, const Agents& agents,
                        const Crowd::ResolveOptions& options, const PairFilter& filter);

}  // namespace bch::detail
