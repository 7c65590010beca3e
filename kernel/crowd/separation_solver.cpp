// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/crowd/separation_solver.hpp"

#include <algorithm>

namespace bch::detail {
namespace {

constexpr int rounds = 20;

}  // namespace

void SeparationSolver::add(std::uint32_t first, std::uint32_t second, double x, double y, double least,
                           Arms arms) {
  const double mobility_of_both =
      mobility(first) * (1 + arms.first * arms.first) + mobility(second) * (1 + arms.second * arms.second);
  if (mobility_of_both > 0) constraints_.push_back({first, second, x, y, least, arms, 1 / mobility_of_both});
}

void SeparationSolver::push(Constraint& constraint) {
  const Constraint& of = constraint;
  const Displacement a = displacements_[of.first],
                     b = of.second == nobody ? Displacement{} : displacements_[of.second];
  const double missing =
      of.least - ((a.x - b.x) * of.x + (a.y - b.y) * of.y + a.turn * of.arms.first - b.turn * of.arms.second);
  const double before = of.pushed;
  constraint.pushed = std::max(0.0, before + of.effective_mass * missing);
  const auto move = [&](std::uint32_t agent, double distance, double arm) {
    if (agent == nobody) return;
    displacements_[agent].x += distance * mobility(agent) * of.x;
    displacements_[agent].y += distance * mobility(agent) * of.y;
    displacements_[agent].turn += distance * mobility(agent) * arm;
  };
  move(of.first, of.pushed - before, of.arms.first);
  move(of.second, before - of.pushed, of.arms.second);
}

void SeparationSolver::solve() {
  for (int round = 0; round < rounds; ++round)
    for (Constraint& constraint : constraints_) push(constraint);
}

}  // namespace bch::detail
