// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/agents.hpp>
#include <bch/characters.hpp>
#include <bch/query.hpp>
#include <bch/shapes.hpp>

namespace bch {

/// Reports an error on one rank, on which all ranks agreed.
/// Each rank throws it with the same message, which names the failed rank.
class RankError : public std::runtime_error {
 public:
  RankError(int failed, const std::string& message) : std::runtime_error(message), rank(failed) {}
  const int rank;  ///< the rank on which the error happened; the lowest of several
};

/// Holds the options of how a crowd is divided among ranks.
struct DistributedCrowdOptions {
  /// The side of the squares that ranks own, metres, at least 1; 0: four times the largest radius.
  double cell = 0;
  double imbalance = 1.04;  ///< the most work of a rank over the mean, beyond which the crowd is cut anew
  /// Gives the work of an agent in addition to its pairs, in pairs.
  /// 0 balances pairs, about 1.3 balances time, and about 600 balances characters, who are posed anew.
  double agent_pairs = 0;
  bool heights = false;  ///< whether z counts; the set has to know the heights of bodies then
};

/// Holds a crowd on all ranks of a communicator; each agent belongs to one rank.
///
///     bch::DistributedCrowd crowd(MPI_COMM_WORLD, shapes, agents);  // any agents on any rank
///     crowd.update();                                               // agents to their ranks, and copies
///     for (const bch::Pair& pair : crowd.collide_all()) ...         // ids
/// See:     kernel/distributed/README.md, for the division, the calls that are collective, and threads.
/// Errors:  where a rank throws, all ranks throw RankError with its message; the crowd can then only be
///          destroyed.
class DistributedCrowd {
 public:
  /// Describes an agent of a crowd that several processes share.
  /// Units:   those of Agents.
  struct Agent {
    double x = 0, y = 0, z = 0, heading = 0;
    std::uint32_t id = 0;     ///< unique in the whole crowd, whichever rank owns the agent
    std::uint32_t shape = 0;  ///< index into the ShapeSet or the characters, the same on every rank
    std::uint8_t level = 0;   ///< index into the depths of the set or the plan
    PoseTime pose = {};  ///< of a character; unused, and not sent, where agents have shapes of a ShapeSet
  };

  /// Names two agents by their ids, first < second, and tells how far apart they are.
  struct Distance {
    std::uint32_t first, second;
    float metres;
    friend bool operator==(const Distance&, const Distance&) = default;
  };

  /// Tells what a rank did in the last update() and the last query, to judge scaling by.
  struct Counters {
    std::uint64_t agents = 0;           ///< agents that it owns
    std::uint64_t halo = 0;             ///< copies of others' agents that it was sent
    std::uint64_t pairs = 0;            ///< candidates that it answered
    std::uint64_t poses = 0;            ///< shapes of poses that it made, copies' too
    std::uint64_t arrived = 0;          ///< agents that came from other ranks
    std::uint64_t migration_bytes = 0;  ///< sent
    std::uint64_t halo_bytes = 0;       ///< sent
    std::uint32_t neighbours = 0;       ///< ranks with which it exchanges halos
    std::uint32_t cuts = 0;             ///< how often the crowd was cut since it was made
    double imbalance = 1;  ///< the most work of a rank in the last query over the mean, as update() saw it
    double cut_seconds = 0, migration_seconds = 0, halo_seconds = 0;  ///< of update()
    double poses_seconds = 0;                                         ///< of update(), where poses are made
    double pairs_seconds = 0, answer_seconds = 0;                     ///< of the query: broad phase, kernel
  };

  /// Takes the agents that this rank knows, each known by one rank; update() brings them to their owners.
  /// Lifetime: the set outlives the crowd. It is the same on every rank: a baked file that each of them maps,
  ///          for instance.
  /// Errors:  as all calls; std::runtime_error where MPI was not initialised for threads.
  DistributedCrowd(MPI_Comm comm, const ShapeSet& shapes, std::vector<Agent> agents,
                   const DistributedCrowdOptions& options = {});
  /// Takes agents who are characters, each in its own pose; `shape` is then an index into the characters.
  /// Each agent is known by one rank. Poses become shapes as by ShapeBuilder and ShapeSet with this plan.
  /// Lifetime: the characters outlive the crowd. They and the plan are the same on every rank.
  /// Errors:  as the other constructor; also on a character or plan that is not valid.
  DistributedCrowd(MPI_Comm comm, std::span<const Character> characters, const ShapeSetPlan& plan,
                   std::vector<Agent> agents, const DistributedCrowdOptions& options = {});
  DistributedCrowd(DistributedCrowd&&) noexcept;
  DistributedCrowd& operator=(DistributedCrowd&&) noexcept;
  ~DistributedCrowd();

  /// Returns the agents of this rank, which a simulator moves, adds and removes as it likes.
  /// Call update() afterwards; it puts them in the order of their ids.
  std::vector<Agent>& agents() noexcept;
  /// Returns copies of other ranks' agents, as they were in the last update().
  /// They are the agents that come as near to this rank's squares as its agents may reach.
  std::span<const Agent> halo() const noexcept;

  /// Brings every agent to its owner, and copies of it to the ranks that need them.
  /// It divides the crowd anew if the pairs of the last query were unbalanced.
  /// Units:   metres; the margin is the largest max_distance of clearances(), the same on all ranks. It is
  ///          not negative, and with two of the largest radii at most 16 squares.
  /// Errors:  names the agent, by its id, and the value that an agent must not have.
  void update(double margin = 0);

  /// Returns the pairs of ids that collide, first < second, as of the last update().
  /// This rank owns the first agent of each.
  /// Memory:  the answer is valid until the next call of a query.
  std::span<const Pair> collide_all(const CollideOptions& options = {});
  /// Returns the pairs of ids that are at most max_distance apart, likewise, with their clearance.
  /// Options: max_distance is at most the margin of the last update().
  std::span<const Distance> clearances(const ClearanceOptions& options);

  const Counters& counters() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
