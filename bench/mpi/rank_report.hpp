// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <mpi.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include <bch/distributed_crowd.hpp>

namespace bch::cli {

/// Holds what a rank did in some steps: means of one, or the most.
struct RankReport {
  double agents = 0, halo = 0, pairs = 0, arrived = 0, sent_bytes = 0, neighbours = 0;
  double cut_seconds = 0, migration_seconds = 0, halo_seconds = 0, pairs_seconds = 0, answer_seconds = 0;
  double memory_bytes = 0;  ///< the most that the process had, beyond what it had before the crowd

  /// Adds a step of so many.
  void add(const CrowdCounters& step, double steps);
};

/// Holds what the crowd did in these steps.
struct CrowdReport {
  std::vector<RankReport> ranks;
  double steps = 0,
         step_seconds = 0;   ///< the median of steps, each of which takes as long as its slowest rank
  double collisions = 0;     ///< in all steps
  std::uint64_t digest = 0;  ///< a sum of hashes of all of them: the same for any number of ranks
  double cuts = 0;

  double agents() const;
  double imbalance() const;       ///< the most pairs of a rank over the mean
  double bytes_an_agent() const;  ///< sent in a step
};

/// Collects the reports of all ranks; on rank 0.
std::vector<RankReport> gather(MPI_Comm comm, const RankReport& report);

std::string text(const CrowdReport& report);
nlohmann::ordered_json to_json(const CrowdReport& report);

}  // namespace bch::cli
