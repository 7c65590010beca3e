// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/distributed_crowd.hpp>

#include "kernel/distributed/posed_shapes.hpp"

namespace bch::detail {

// What would lead an agent astray before a query examines it. Each throws std::invalid_argument that names the agent and the value.

/// Requires that an agent is somewhere. `heights`: whether z counts.
void require_valid(const DistributedCrowd::Agent& agent, bool heights);
/// Requires that its shape and level are of a set.
void require_valid(const DistributedCrowd::Agent& agent, const ShapeSet& shapes);
/// Requires that its character, level and pose are there.
void require_valid(const DistributedCrowd::Agent& agent, const PosedShapes& shapes);

}  // namespace bch::detail
