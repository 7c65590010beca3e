// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "bench/workload/scene.hpp"

namespace bch::bench {

/// Represents something to be timed, whose answers were compared.
struct Contender {
  std::function<void()> call;
  std::size_t items = 1;                        ///< of a call: pairs, agents or poses
  std::map<std::string, double> counters = {};  ///< what else is worth telling
};

/// Makes a contender that asks a kernel's implementation for all pairs of a workload.
/// Errors of both: throw std::runtime_error on wrong answers.
Contender kernel_contender(Scene& scene, const Workload& workload, const QueryOptions& query,
                           const Implementation& implementation);
Contender structure_contender(Scene& scene, const Workload& workload, std::string_view kind);

/// Represents a question beside collide(), of all of a workload's pairs or its agents.
/// Errors of both: throw std::runtime_error on wrong answers.
struct TimedQuery {
  const char* name;
  Contender (*kernel)(Scene&, const Workload&, const Implementation&);
  Contender (*reference)(Scene&, const Workload&);  ///< may be null
};

/// Returns clearance(), with directions, within(), and time_of_impact(). The references are scalar searches with the
/// same pruning.
std::span<const TimedQuery> distance_queries();
/// Returns ContactFinder::find(); penetration(), along the best of 16 directions; collide_all(), whose pairs are those of
/// its broad phase. The reference is brute force; collide_all() has none, as that of collide() serves for it.
std::span<const TimedQuery> response_queries();

/// Makes a contender that measures FCL's distances of the outlines, as walls, which is what is asked for, or as
/// one triangle a segment, which is half of the work. Only in a build with FCL: see has_kind().
Contender fcl_distance_contender(Scene& scene, const Workload& workload, bool walls);

/// Checks that nothing is wrong: throws std::runtime_error if `wrong` is not empty.
void require_right(std::string_view name, const Workload& workload, const std::string& wrong);

/// Returns whether this build has the kind.
bool has_kind(std::string_view kind);

}  // namespace bch::bench
