// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include "layout/agents.hpp"
#include "layout/shape_set.hpp"

namespace bch {

/// Every pair of agents whose root discs, at the agents' levels, can overlap: once each, first < second,
/// sorted by first, then second. No pair that collide() answers with 1 is left out; few others than those
/// whose root discs overlap are in. A uniform grid of the largest root's diameter: meant for agents of like
/// size. The same for any number of threads.
/// Errors:  throws std::invalid_argument like validate(shapes, agents).
/// Threads: runs in the caller's TBB arena.
std::vector<Pair> candidate_pairs(const ShapeSet& shapes, const Agents& agents);

}  // namespace bch
