// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <mpi.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include <bch/distributed_crowd.hpp>

namespace bch::cli {

/// Adds the command that lets a crowd walk on all ranks, and tells what each of them did. Returns what runs
/// the command.
std::function<void()> add_crowd_command(CLI::App& program, MPI_Comm comm);

/// The words for kinds of crowds: uniform; spot, a quarter of all in a disc at four times the density; stadium, half of all on stands
/// at twice the density around half of it; street, all in streets of 10 m, 100 m apart.
extern const std::vector<std::string> scenery_kinds;

/// Places the agents of a crowd. Each agent is drawn by its number alone, so that a rank needs no other's.
class Scenery {
 public:
  /// Takes a kind, the number of agents, and their density per square metre.
  Scenery(const std::string& kind, std::uint64_t agents, double density);

  /// Returns an agent, with a shape of so many; its level is 0.
  DistributedCrowd::Agent agent(std::uint64_t number, std::uint32_t shapes) const;

 private:
  /// Represents a part of the crowd that is equally dense in an area.
  struct Layer {
    double fraction;
    double half_side;           ///< of a square, of which streets take a tenth
    bool rows, columns;         ///< streets
    double inner, outer, x, y;  ///< of a ring, where outer is not 0
    bool contains(double px, double py) const;
  };

  std::vector<Layer> layers_;
};

/// Holds what a rank did in some steps: means of one, or the most.
struct RankReport {
  double agents = 0, halo = 0, pairs = 0, arrived = 0, sent_bytes = 0, neighbours = 0;
  double cut_seconds = 0, migration_seconds = 0, halo_seconds = 0, pairs_seconds = 0, answer_seconds = 0;
  double memory_bytes = 0;  ///< the most that the process had, beyond what it had before the crowd

  /// Adds a step of so many.
  void add(const DistributedCrowd::Counters& step, double steps);
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
