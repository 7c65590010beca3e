// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include <bch/crowd.hpp>
#include <bch/pairs.hpp>

#include "kernel/crowd/crowd_memory.hpp"
#include "kernel/crowd/resolution.hpp"
#include "kernel/penetration/spread_axes.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/shortest.hpp"

// A sweep is a step of a solver of contacts. Pairs that collide are to move by their shortest moves, nearest_free(); pairs that are near are
// to stay apart along the direction of their clearances, so that nobody is pushed into somebody else. The displacements that do both, and
// are the smallest, are found for all agents together. Along other directions than their own, bodies are farther or nearer than these lines say, and
// so there are several sweeps. Those who are entangled may push each other to and fro for ever: now and then pairs are to move until a
// line separates them, as penetration() says, which costs them more room.

namespace bch::detail {
namespace {

constexpr std::uint32_t sweeps_to_disentangle = 8;
constexpr double longest_step = 1000;  ///< metres
constexpr double longest_turn = 3.2;   ///< radians: half a turn
/// A nearest point above or below says nothing of the ground: directions have at least this length there.
constexpr double least_on_ground = 0.3;

void require_length(const char* what, double length, double most) {
  if (length >= 0 && length <= most) return;
  throw std::invalid_argument(std::string("resolve: expected a ") + what + " of 0 to " + shortest(most) +
                              " m, found " + shortest(length));
}

void require_valid(const Crowd::ResolveOptions& options, std::size_t agents) {
  spread_axes("resolve", options.directions);
  require_length("gap", options.gap, longest_step);
  require_length("largest_step", options.largest_step, longest_step);
  require_length("largest_shift", options.largest_shift, std::numeric_limits<double>::infinity());
  if (!(options.largest_turn >= 0 && options.largest_turn <= longest_turn))
    throw std::invalid_argument("resolve: expected a largest_turn of 0 to " + shortest(longest_turn) +
                                " rad, found " + shortest(options.largest_turn));
  if (!options.mobility.empty())
    check_size({"resolve", "agent", agents}, options.mobility.size(), "mobilities");
  for (std::size_t i = 0; i < options.mobility.size(); ++i)
    if (!(options.mobility[i] >= 0 && options.mobility[i] <= 1))
      throw std::invalid_argument("resolve: agent " + std::to_string(i) +
                                  ": expected a mobility of 0 to 1, found " + shortest(options.mobility[i]));
}

/// Makes a vector shorter where it is longer than `most`.
void shorten(double& x, double& y, double most) {
  const double length = std::sqrt(x * x + y * y);
  if (!(length > most)) return;
  x *= most / length, y *= most / length;
}

/// Adds that an agent comes nearer to another, or to nobody, which is a wall, by no more than `clearance_left`; below 0 it has to go so far
/// away. The direction leads to the other.
void limit_approach(SeparationSolver& solver, std::uint32_t first, std::uint32_t second,
                    const Vec3& direction, double clearance_left) {
  const double x{direction.x}, y{direction.y}, length = std::sqrt(x * x + y * y);
  if (length >= least_on_ground)
    solver.add(first, second, -x / length, -y / length, -clearance_left / length);
}

}  // namespace

void Resolution::begin(const Agents& agents, bool may_turn) {
  turn.assign(may_turn ? agents.size() : 0, 0);
  x.resize(agents.size()), y.resize(agents.size());
  for (std::size_t i = 0; i < agents.size(); ++i) x[i] = agents.x[i], y[i] = agents.y[i];
  first_x = x, first_y = y;
}

void Resolution::move(const Crowd::ResolveOptions& options) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    double dx = solver.displacement(i).x, dy = solver.displacement(i).y;
    shorten(dx, dy, options.largest_step);
    double shift_x = x[i] + dx - first_x[i], shift_y = y[i] + dy - first_y[i];
    shorten(shift_x, shift_y, options.largest_shift);
    x[i] = first_x[i] + shift_x, y[i] = first_y[i] + shift_y;
  }
  for (std::size_t i = 0; i < turn.size(); ++i) {
    const double step = std::clamp(solver.displacement(i).turn, -options.largest_step, options.largest_step);
    turn[i] = std::clamp(turn[i] + step / SeparationSolver::turn_length, -options.largest_turn,
                         options.largest_turn);
  }
}

void Resolution::set_headings(const Headings& headings) {
  heading_x.resize(turn.size()), heading_y.resize(turn.size());
  for (std::size_t i = 0; i < turn.size(); ++i) {
    const Rotation from = rotation(headings[i]), by = rotation(turn[i]);
    heading_x[i] = from.cosine * by.cosine - from.sine * by.sine;
    heading_y[i] = from.sine * by.cosine + from.cosine * by.sine;
  }
}

namespace {

/// Sweeps over the agents of a crowd.
class Sweeps {
 public:
  Sweeps(CrowdMemory& memory, const BodySet& bodies, const Agents& agents,
         const Crowd::ResolveOptions& options, const PairFilter& filter)
      : memory_(memory),
        of_(memory.resolution),
        bodies_(bodies),
        given_(agents),
        agents_(agents),
        options_(options),
        filter_(filter),
        margin_(options.gap + 2 * options.largest_step) {
    of_.begin(agents, options.largest_turn > 0);
    agents_.x = of_.x, agents_.y = of_.y;
    set_headings();
  }

  Crowd::Resolved run() {
    for (std::uint32_t sweep = 0;; ++sweep) {
      of_.solver.begin(agents_.size(), options_.mobility);
      is_open_ = false;
      add_walls();
      add_pairs(sweep);
      if (!is_open_ || sweep == options_.sweeps)
        return {of_.x, of_.y, of_.turn, memory_.kept_pairs(), of_.agents_at_walls, sweep};
      of_.solver.solve();
      of_.move(options_);
      set_headings();
    }
  }

 private:
  void set_headings() {
    if (of_.turn.empty()) return;
    of_.set_headings(given_.heading);
    agents_.heading = Headings(of_.heading_x, of_.heading_y);
  }

  /// Returns how far the point of touch of pair i, of agents or their images, moves along (x, y) as each agent turns.
  SeparationSolver::Arms arms(const Agents& agents, std::size_t i) const {
    if (of_.touches.empty()) return {};
    const auto [first, second] = memory_.to_separate[i];
    const auto [depth, x, y] = memory_.penetrations[i];
    const double at_x{of_.touches[i].point.x}, at_y{of_.touches[i].point.y};
    const double from_x = at_x + agents.x[first] + double{depth} * x - agents.x[second],
                 from_y = at_y + agents.y[first] + double{depth} * y - agents.y[second];
    return {(at_x * y - at_y * x) / SeparationSolver::turn_length,
            (from_x * y - from_y * x) / SeparationSolver::turn_length};
  }

  /// Keeps the pairs that collide.
  void add_pairs(std::uint32_t sweep) {
    const CrowdMemory::Candidates candidates = memory_.find(bodies_, agents_, margin_, filter_);
    const auto& distance = memory_.distance.of_candidates;
    const auto& direction = memory_.space_direction.of_candidates;
    memory_.distance.of_candidates.resize(candidates.pairs.size());
    memory_.space_direction.of_candidates.resize(candidates.pairs.size());
    clearance(bodies_, candidates.agents, candidates.pairs,
              {memory_.distance.of_candidates, memory_.space_direction.of_candidates},
              {.implementation = options_.implementation, .max_distance = margin_});
    memory_.keep(candidates.pairs, [&](std::size_t i) { return distance[i] == 0; });
    const auto measure = [&](const auto& query) {
      memory_.measure_kept(bodies_, candidates, options_.directions, options_.implementation, query);
    };
    of_.touches.clear();
    if (sweep % sweeps_to_disentangle == 0 && sweep > 0) {
      measure(CrowdMemory::by_penetration);
    } else {
      if (!of_.turn.empty()) of_.touches.resize(memory_.pairs.size());
      measure([this](auto&&... of) { nearest_free(of..., of_.touches); });
    }
    for (std::size_t i = 0; i < memory_.pairs.size(); ++i) {
      const auto [first, second] = memory_.pairs[i];
      const auto [depth, x, y] = memory_.penetrations[i];
      of_.solver.add(first, second, x, y, double{depth} + options_.gap, arms(candidates.agents, i));
      is_open_ |= of_.solver.mobility(first) + of_.solver.mobility(second) > 0;
    }
    for (std::size_t i = 0; i < candidates.pairs.size(); ++i) {
      if (!(distance[i] > 0 && double{distance[i]} <= margin_)) continue;
      const auto [first, second] = memory_.named(candidates.pairs[i]);
      limit_approach(of_.solver, first, second, direction[i],
                     std::max(0.0, double{distance[i]} - options_.gap));
    }
  }

  void add_walls() {
    of_.agents_at_walls.clear();
    if (options_.obstacles == nullptr) return;
    of_.wall_distance.resize(agents_.size()), of_.wall_direction.resize(agents_.size());
    clearance(bodies_, agents_, *options_.obstacles, {of_.wall_distance, of_.wall_direction},
              {options_.implementation, margin_, Overlap::deepest});
    for (std::uint32_t i = 0; i < agents_.size(); ++i) {
      const double distance{of_.wall_distance[i]};
      if (!(distance <= margin_)) continue;
      const bool touches = distance <= 0;
      if (touches) of_.agents_at_walls.push_back(i);
      is_open_ |= touches && of_.solver.mobility(i) > 0;
      const double clearance_left = distance - options_.gap;
      limit_approach(of_.solver, i, SeparationSolver::nobody, of_.wall_direction[i],
                     touches ? clearance_left : std::max(0.0, clearance_left));
    }
  }

  CrowdMemory& memory_;
  Resolution& of_;
  const BodySet& bodies_;
  const Agents& given_;
  Agents agents_;
  const Crowd::ResolveOptions& options_;
  const PairFilter& filter_;
  double margin_;
  bool is_open_ = false;  ///< whether somebody who may move collides
};

}  // namespace

Crowd::Resolved resolve(CrowdMemory& memory, const BodySet& bodies, const Agents& agents,
                        const Crowd::ResolveOptions& options, const PairFilter& filter) {
  const FloatingPointStateGuard floats;
  require_valid_agents(bodies.view().ground, agents);
  require_valid(options, agents.size());
  return Sweeps(memory, bodies, agents, options, filter).run();
}

}  // namespace bch::detail
