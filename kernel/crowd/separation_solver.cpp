// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/crowd/separation_solver.hpp"

#include <algorithm>

namespace bch::detail {
namespace {

constexpr int rounds = 20;

}  // namespace

void SeparationSolver::add(std::uint32_t first, std::uint32_t second, double x, double y, double least) {
  const double mobility_of_both = mobility(first) + mobility(second);
  if (mobility_of_both > 0) constraints_.push_back({first, second, x, y, least, 1 / mobility_of_both});
}

void SeparationSolver::push(Constraint& constraint) {
  const auto [first, second, x, y, least, share, pushed] = constraint;
  Displacement& a = displacements_[first];
  const Displacement b = second == nobody ? Displacement{} : displacements_[second];
  const double missing = least - ((a.x - b.x) * x + (a.y - b.y) * y);
  constraint.pushed = std::max(0.0, pushed + share * missing);
  const double change = constraint.pushed - pushed;
  const auto go = [&](Displacement& d, double way) { d.x += way * x, d.y += way * y; };
  go(a, mobility(first) * change);
  if (second != nobody) go(displacements_[second], -mobility(second) * change);
}

void SeparationSolver::solve() {
  for (int round = 0; round < rounds; ++round)
    for (Constraint& constraint : constraints_) push(constraint);
}

}  // namespace bch::detail
