// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <bch/query.hpp>

#include "bench/base/csv_input.hpp"

namespace bch::cli {

/// Returns all pairs that collide or, with a finite max_distance, are within it, in the order of the agents' lines. `what`: "within" counts
/// as that query does, also who stands inside whom; else distances count alone.
/// Errors:  throws std::length_error where there are more pairs of neighbours than `most`.
std::vector<Pair> all_pairs(const ShapeSet& set, const AgentTable& table, const std::string& what,
                            const QueryOptions& options, std::size_t most);

}  // namespace bch::cli
