// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>
#include <vector>

#include <bch/query.hpp>

#include "bench/base/csv_input.hpp"

namespace bch::cli {

/// Returns all pairs that are within max_distance of each other, in the order of the agents' lines. `what`: "within" counts as that query
/// does, also who stands inside whom; else distances count alone.
std::vector<Pair> near_pairs(const ShapeSet& set, const AgentTable& table, const std::string& what,
                             const QueryOptions& options);

/// Returns all pairs that collide, in the same order.
std::vector<Pair> colliding_pairs(const ShapeSet& set, const Agents& agents, const QueryOptions& options);

}  // namespace bch::cli
