// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/mpi/cut_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/distributed/cut.hpp"
#include "kernel/distributed/halo.hpp"
#include "layout/base/random.hpp"

namespace bch::cli {

using namespace detail;

namespace {

constexpr double step_length = 1.3 / 30;  ///< metres a step
constexpr double weight_unit = 1e-3;      ///< of a pair: weights are whole numbers

class CutSimulation {
 public:
  CutSimulation(const Scenery& scenery, const SimulatedBodies& bodies, int ranks, double agent_pairs)
      : scenery_(scenery),
        side_(std::max(1.0, 4 * bodies.reach)),
        disc_(bodies.disc),
        reach_(2 * bodies.reach),
        agent_pairs_(agent_pairs),
        ranks_(static_cast<std::size_t>(ranks)) {}

  std::vector<SimulatedRank> run() {
    std::vector<Weight> weights;
    for_squares([&](Cell cell, double agents) {
      weights.push_back(
          {curve_key(cell),
           static_cast<std::uint64_t>((pairs_of(agents) + agent_pairs_ * agents) / weight_unit) + 1});
    });
    std::ranges::sort(weights, {}, &Weight::key);
    cut_ = cut_evenly(static_cast<int>(ranks_.size()), weight_before(weights));
    owners_.reset(cut_, 1);
    for_squares([&](Cell cell, double agents) { add(cell, agents); });
    return ranks_;
  }

 private:
  /// Calls visit(square, agents) for all squares that have some.
  template <class Visit>
  void for_squares(const Visit& visit) const {
    const auto last = static_cast<std::int32_t>(std::ceil(scenery_.half_side() / side_));
    for (std::int32_t y = -last; y < last; ++y)
      for (std::int32_t x = -last; x < last; ++x) {
        const double density = scenery_.density((x + 0.5) * side_, (y + 0.5) * side_);
        if (density > 0) visit(Cell{x, y}, density * side_ * side_);
      }
  }

  /// Pairs of which a square's agents are one.
  double pairs_of(double agents) const {
    return agents * agents / (side_ * side_) * std::numbers::pi * (2 * disc_) * (2 * disc_) / 2;
  }

  void add(Cell cell, double agents) {
    const CellOwners::Owner owner = owners_[cell];
    SimulatedRank& rank = ranks_[static_cast<std::size_t>(owner.rank)];
    rank.agents += agents, rank.pairs += pairs_of(agents);
    if (!owner.is_inner) add_border(cell, agents, owner.rank);
  }

  void add_border(Cell cell, double agents, int owner) {
    Random random(curve_key(cell));
    std::vector<CrowdAgent> drawn(static_cast<std::size_t>(agents + random.uniform(1)));
    for (CrowdAgent& agent : drawn)
      agent.x = (cell.x + random.uniform(1)) * side_, agent.y = (cell.y + random.uniform(1)) * side_;
    std::vector<Copy> copies;
    find_copies(drawn, {std::span(&reach_, 1), side_, owner}, owners_, copies);
    SimulatedRank& from = ranks_[static_cast<std::size_t>(owner)];
    from.sent += copies.size();
    for (const Copy& copy : copies) {
      SimulatedRank& to = ranks_[static_cast<std::size_t>(copy.rank)];
      ++to.halo, to.neighbours.insert(owner), from.neighbours.insert(copy.rank);
    }
    for (CrowdAgent& agent : drawn) {
      const double heading = random.uniform(2 * std::numbers::pi);
      agent.x += step_length * std::cos(heading), agent.y += step_length * std::sin(heading);
      from.migrants += owners_[cell_at(agent.x, agent.y, side_)].rank != owner;
    }
  }

  const Scenery& scenery_;
  double side_, disc_, reach_, agent_pairs_;
  std::vector<SimulatedRank> ranks_;
  Cut cut_;
  CellOwners owners_;
};

}  // namespace

SimulatedBodies bodies_of(const ShapeSet& set) {
  SimulatedBodies bodies{0, 0};
  for (std::uint32_t shape = 0; shape < set.shape_count(); ++shape) {
    bodies.reach = std::max<double>(bodies.reach, set.bounding_radius(shape));
    bodies.disc += static_cast<double>(set.discs(shape, 0).front().radius) / set.shape_count();
  }
  return bodies;
}

std::vector<SimulatedRank> simulate_cut(const Scenery& scenery, const SimulatedBodies& bodies, int ranks,
                                        double agent_pairs) {
  return CutSimulation(scenery, bodies, ranks, agent_pairs).run();
}

}  // namespace bch::cli
