// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include "bench/workload/race.hpp"

namespace bch::bench {

/// Return the queries of clearance(), with directions, and of time_of_impact(). The references are scalar
/// searches with the same pruning.
const TimedQuery& clearance_query();
const TimedQuery& time_of_impact_query();

/// Returns FCL's distances of the outlines: as walls, which is what is asked for, and as one triangle a
/// segment, which is half of the work; none in a build without FCL.
std::vector<Contender> fcl_distance_contenders(Scene& scene, const Workload& workload);

}  // namespace bch::bench
