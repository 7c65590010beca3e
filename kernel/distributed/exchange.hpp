// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

#include <bch/distributed_crowd.hpp>

namespace bch::detail {

/// Says how MPI sends an agent: the fields that are needed, without what lies between them.
class AgentType {
 public:
  /// Describes an agent to MPI, with or without z and the pose.
  AgentType(bool heights, bool poses);
  ~AgentType();
  AgentType(const AgentType&) = delete;
  AgentType& operator=(const AgentType&) = delete;

  MPI_Datatype get() const { return type_; }
  /// Returns the number of bytes that travel.
  std::size_t bytes() const;

 private:
  MPI_Datatype type_;
};

/// Represents a communicator of our own, so that nothing of the caller's is mixed with it.
class OwnComm {
 public:
  explicit OwnComm(MPI_Comm of) { MPI_Comm_dup(of, &comm_); }
  ~OwnComm() { MPI_Comm_free(&comm_); }
  OwnComm(const OwnComm&) = delete;
  OwnComm& operator=(const OwnComm&) = delete;

  MPI_Comm get() const { return comm_; }
  int rank() const;
  int size() const;

 private:
  MPI_Comm comm_;
};

/// Records in the order in which they are sent, and how many to each receiver.
struct Outbox {
  std::vector<DistributedCrowd::Agent> agents;
  std::vector<int> counts;
};

/// Sends to every rank what is for it, and appends what comes.
void exchange_with_all(const OwnComm& comm, const AgentType& type, const Outbox& out,
                       std::vector<DistributedCrowd::Agent>& in);

/// Holds the ranks that a rank exchanges halos with: where one sends to another, it gets from it, too, be it nothing.
class NeighbourGraph {
 public:
  NeighbourGraph() = default;
  ~NeighbourGraph() { reset(); }
  NeighbourGraph(const NeighbourGraph&) = delete;
  NeighbourGraph& operator=(const NeighbourGraph&) = delete;

  /// Takes in all that some rank is to send to: flags by rank. Collective; makes a new graph only where one is needed.
  void include(const OwnComm& comm, std::span<const char> receivers);
  /// Forgets all neighbours.
  void reset();
  std::span<const int> ranks() const { return ranks_; }
  /// Sends to each neighbour, in the order of ranks(), what is for it; `in` is what comes.
  void exchange(const OwnComm& comm, const AgentType& type, const Outbox& out,
                std::vector<DistributedCrowd::Agent>& in) const;

 private:
  std::vector<int> ranks_;
  MPI_Comm graph_ = MPI_COMM_NULL;
};

}  // namespace bch::detail
