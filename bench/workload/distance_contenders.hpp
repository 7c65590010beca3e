// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include "bench/workload/race.hpp"

namespace bch::bench {

/// clearance(), with directions; contact_time(). The references are scalar searches with the same pruning.
const TimedQuery& clearance_query();
const TimedQuery& contact_time_query();

/// FCL's distances of the outlines as walls, which is what is asked for, and as one triangle a segment, half of what it
/// has to look at; none in a build without FCL.
std::vector<Contender> fcl_distance_contenders(Scene& scene, const Workload& workload);

}  // namespace bch::bench
