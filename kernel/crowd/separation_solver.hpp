// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bch::detail {

/// Finds small displacements of agents on the ground that separate pairs and keep others apart, as physics engines solve
/// contacts (projected Gauss-Seidel). Reuses its memory.
///
/// A constraint between two agents is (d_first - d_second) . (x, y) >= least, where d also has the displacement, by a turn of the
/// agent, of the point at which the two touch. Each one pushes its agents apart, in proportion
/// to their mobilities, and never pulls, but may undo earlier pushes of its own. The displacements converge to those with the
/// least sum of squares. Constraints push in the order in which they were added, on one thread, so that the bits depend on
/// nothing else.
class SeparationSolver {
 public:
  static constexpr std::uint32_t nobody = 0xffffffff;  ///< the second agent of a constraint with a wall

  /// Turning by an angle counts as much as a displacement by this times the angle; metres. Half a shoulder's width.
  static constexpr double turn_length = 0.2;

  struct Displacement {
    double x = 0, y = 0;
    double turn = 0;  ///< radians times turn_length
  };
  /// Holds how far the point of touch moves along (x, y) as an agent turns by 1 / turn_length; 0: it may not turn.
  struct Arms {
    double first = 0, second = 0;
  };

  /// Begins with displacements of 0. `mobility` has one number per agent, or none (1 each), and has to outlive solve().
  void begin(std::size_t agents, std::span<const double> mobility) {
    mobility_ = mobility;
    displacements_.assign(agents, {});
    constraints_.clear();
  }

  /// Adds a constraint; (x, y) is a unit vector. One between agents that cannot move is ignored.
  void add(std::uint32_t first, std::uint32_t second, double x, double y, double least, Arms arms = {0, 0});
  void solve();

  double mobility(std::uint32_t agent) const {
    if (agent == nobody) return 0;
    return mobility_.empty() ? 1 : mobility_[agent];
  }
  Displacement displacement(std::size_t agent) const { return displacements_[agent]; }

 private:
  struct Constraint {
    std::uint32_t first, second;
    double x, y, least;
    Arms arms;
    double effective_mass;  ///< each agent moves by this times its mobility per missing metre
    double pushed = 0;      ///< sum of all pushes
  };

  void push(Constraint& constraint);

  std::span<const double> mobility_;
  std::vector<Displacement> displacements_;
  std::vector<Constraint> constraints_;
};

}  // namespace bch::detail
