// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/exchange.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "kernel/distributed/agreement.hpp"
#include "kernel/distributed/resize.hpp"

namespace bch::detail {
namespace {

std::vector<int> offsets_of(std::span<const int> counts) {
  std::vector<int> offsets(counts.size(), 0);
  if (!counts.empty()) std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
  return offsets;
}

int sum_of(std::span<const int> counts) {
  return std::accumulate(counts.begin(), counts.end(), 0);
}

}  // namespace

AgentType::AgentType(bool heights, bool poses) {
  constexpr std::size_t pose = offsetof(DistributedCrowd::Agent, pose);
  const MPI_Datatype types[] = {MPI_DOUBLE, MPI_DOUBLE, MPI_UINT32_T, MPI_UINT8_T, MPI_UINT32_T, MPI_FLOAT};
  const int lengths[] = {heights ? 3 : 2, 1, 2, 1, poses, poses};  // x, y, z; heading; id, shape; level; pose
  const MPI_Aint places[] = {
      offsetof(DistributedCrowd::Agent, x),  offsetof(DistributedCrowd::Agent, heading),
      offsetof(DistributedCrowd::Agent, id), offsetof(DistributedCrowd::Agent, level),
      pose + offsetof(PoseTime, clip),       pose + offsetof(PoseTime, seconds)};
  MPI_Datatype fields;
  MPI_Type_create_struct(6, lengths, places, types, &fields);
  MPI_Type_create_resized(fields, 0, sizeof(DistributedCrowd::Agent), &type_);
  MPI_Type_free(&fields);
  MPI_Type_commit(&type_);
}

AgentType::~AgentType() {
  MPI_Type_free(&type_);
}

std::size_t AgentType::bytes() const {
  int bytes;
  MPI_Type_size(type_, &bytes);
  return static_cast<std::size_t>(bytes);
}

int OwnComm::rank() const {
  int rank;
  MPI_Comm_rank(comm_, &rank);
  return rank;
}

int OwnComm::size() const {
  int size;
  MPI_Comm_size(comm_, &size);
  return size;
}

void exchange_with_all(const OwnComm& comm, const AgentType& type, const Outbox& out,
                       std::vector<DistributedCrowd::Agent>& in) {
  const std::size_t before = in.size();
  std::vector<int> counts, from, to;
  agree(comm.get(), [&] { counts.resize(out.counts.size()), to = offsets_of(out.counts); });
  MPI_Alltoall(out.counts.data(), 1, MPI_INT, counts.data(), 1, MPI_INT, comm.get());
  agree(comm.get(), [&] {
    from = offsets_of(counts);
    resize_with_spare(in, before + static_cast<std::size_t>(sum_of(counts)));
  });
  MPI_Alltoallv(out.agents.data(), out.counts.data(), to.data(), type.get(), in.data() + before,
                counts.data(), from.data(), type.get(), comm.get());
}

void NeighbourGraph::reset() {
  if (graph_ != MPI_COMM_NULL) MPI_Comm_free(&graph_);
  ranks_.clear();
}

void NeighbourGraph::include(const OwnComm& comm, std::span<const char> receivers) {
  std::vector<char> outgoing(receivers.begin(), receivers.end()), incoming(receivers.size());
  for (const int rank : ranks_) outgoing[static_cast<std::size_t>(rank)] = 1;
  int is_new = graph_ == MPI_COMM_NULL ||
               std::ranges::count(outgoing, 1) != static_cast<std::ptrdiff_t>(ranks_.size());
  MPI_Allreduce(MPI_IN_PLACE, &is_new, 1, MPI_INT, MPI_MAX, comm.get());
  if (!is_new) return;
  MPI_Alltoall(outgoing.data(), 1, MPI_CHAR, incoming.data(), 1, MPI_CHAR, comm.get());
  reset();
  for (int rank = 0; const char is_outgoing : outgoing) {
    if (is_outgoing != 0 || incoming[static_cast<std::size_t>(rank)] != 0) ranks_.push_back(rank);
    ++rank;
  }
  const int degree = static_cast<int>(ranks_.size());
  const std::vector<int> weights(ranks_.size() + 1,
                                 1);  // some MPIs take no null pointer where there is no neighbour
  const int none = 0;
  const int* const others = ranks_.empty() ? &none : ranks_.data();
  MPI_Dist_graph_create_adjacent(comm.get(), degree, others, weights.data(), degree, others, weights.data(),
                                 MPI_INFO_NULL, 0, &graph_);
}

void NeighbourGraph::exchange(const OwnComm& comm, const AgentType& type, const Outbox& out,
                              std::vector<DistributedCrowd::Agent>& in) const {
  std::vector<int> counts, from, to;
  agree(comm.get(), [&] { counts.resize(ranks_.size() + 1), to = offsets_of(out.counts); });
  MPI_Neighbor_alltoall(out.counts.data(), 1, MPI_INT, counts.data(), 1, MPI_INT, graph_);
  counts.resize(ranks_.size());
  agree(comm.get(), [&] {
    from = offsets_of(counts);
    resize_with_spare(in, static_cast<std::size_t>(sum_of(counts)));
  });
  MPI_Neighbor_alltoallv(out.agents.data(), out.counts.data(), to.data(), type.get(), in.data(),
                         counts.data(), from.data(), type.get(), graph_);
}

}  // namespace bch::detail
