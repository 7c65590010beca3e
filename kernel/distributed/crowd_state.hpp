// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <optional>
#include <span>
#include <vector>

#include <bch/distributed_crowd.hpp>
#include "kernel/broad_phase/broad_phase.hpp"

#include "kernel/distributed/cut.hpp"
#include "kernel/distributed/exchange.hpp"
#include "kernel/distributed/halo.hpp"
#include "kernel/distributed/owned_pairs.hpp"
#include "kernel/distributed/posed_shapes.hpp"
#include "kernel/distributed/session.hpp"

namespace bch::detail {

/// Adds the seconds of its lifetime to a counter.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), begin_(MPI_Wtime()) {}
  ~Stopwatch() { seconds_ += MPI_Wtime() - begin_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  double begin_;
};

/// Holds what a rank knows of a distributed crowd, and the steps of update() and of queries, which all ranks take together.
struct CrowdState {
  CrowdState(MPI_Comm of, const ShapeSet& set, std::vector<DistributedCrowd::Agent> mine,
             const DistributedCrowdOptions& how);
  CrowdState(MPI_Comm of, std::span<const Character> characters, const ShapeSetPlan& plan,
             std::vector<DistributedCrowd::Agent> mine, const DistributedCrowdOptions& how);
  CrowdState(MPI_Comm of, bool poses, std::vector<DistributedCrowd::Agent> mine,
             const DistributedCrowdOptions& how);

  void prepare(bool has_heights);
  const ShapeSet& shapes() const { return posed ? posed->set() : *baked; }
  void visit_agents() const;
  void sort_agents();
  void require_margin(double metres) const;
  std::int32_t ring() const;
  void update(double apart);
  std::uint64_t agent_weight() const;
  void cut_where_unbalanced();
  std::vector<Weight> weights() const;
  Outbox leaving();
  void migrate();
  void make_own_poses(double apart);
  void learn_reach(double apart);
  Outbox copies();
  void exchange_halo();
  void fill_columns();
  void find_pairs(double metres);
  std::size_t index(std::int32_t rank) const { return static_cast<std::size_t>(rank); }

  OwnComm comm;
  AgentType whole,
      copied;  ///< agents that leave with all that is known of them; copies with what queries need
  const ShapeSet* baked = nullptr;   ///< where agents have shapes of a set
  std::optional<PosedShapes> posed;  ///< where they are characters
  DistributedCrowdOptions options;
  std::vector<double> radii, reach;
  double side = 1, margin = 0;
  std::vector<DistributedCrowd::Agent> agents, halo;
  Cut cut;
  double promised = 1;  ///< the imbalance that the last cut could not avoid
  CellOwners owners;
  NeighbourGraph graph;
  CrowdColumns columns;
  BroadPhase broad_phase;
  std::vector<Pair> pairs, colliding;
  std::vector<std::uint8_t> hits;
  std::vector<float> metres;
  std::vector<DistributedCrowd::Distance> near;
  DistributedCrowd::Counters counters;
};

}  // namespace bch::detail
