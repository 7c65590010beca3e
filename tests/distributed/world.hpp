// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>
#include <vector>

#include <bch/crowd.hpp>
#include <bch/distributed_crowd.hpp>
#include <bch/pairs.hpp>

#include "kernel/runtime/all_options.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/scenes.hpp"

// A crowd on all ranks, and the same one on each of them.

namespace bch::test {

inline int rank() {
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

inline int ranks() {
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

struct Answer {
  std::uint32_t first, second;
  float metres;  ///< 0 of collisions
  friend auto operator<=>(const Answer&, const Answer&) = default;
};
using Answers = std::vector<Answer>;

/// The values of all ranks, on each of them.
template <class Value>
std::vector<Value> of_all_ranks(const std::vector<Value>& mine) {
  std::vector<int> sizes(static_cast<std::size_t>(ranks())), begins(sizes);
  const int size = static_cast<int>(mine.size() * sizeof(Value));
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::exclusive_scan(sizes.begin(), sizes.end(), begins.begin(), 0);
  std::vector<Value> all(static_cast<std::size_t>(begins.back() + sizes.back()) / sizeof(Value));
  MPI_Allgatherv(mine.data(), size, MPI_BYTE, all.data(), sizes.data(), begins.data(), MPI_BYTE,
                 MPI_COMM_WORLD);
  return all;
}

inline Answers sorted(Answers answers) {
  std::ranges::sort(answers);
  return answers;
}

inline Answers collisions(DistributedCrowd& crowd, const detail::AllOptions& options = {}) {
  Answers mine;
  for (const Pair& pair : crowd.collide_all(options)) mine.push_back({pair.first, pair.second, 0});
  return sorted(of_all_ranks(mine));
}

inline Answers clearances(DistributedCrowd& crowd, const detail::AllOptions& options) {
  Answers mine;
  for (const DistributedCrowd::Distance& one : crowd.clearances(options))
    mine.push_back({one.first, one.second, one.metres});
  return sorted(of_all_ranks(mine));
}

/// The whole crowd, as one process has it: in the order of ids.
struct World {
  std::vector<DistributedCrowd::Agent> agents;
  bool has_heights = false;

  /// The agents that a rank begins with: one here, one there, in no order.
  std::vector<DistributedCrowd::Agent> dealt() const {
    std::vector<DistributedCrowd::Agent> mine;
    for (std::size_t i = 0; i < agents.size(); ++i)
      if (i % static_cast<std::size_t>(ranks()) == static_cast<std::size_t>(rank()))
        mine.push_back(agents[i]);
    std::ranges::reverse(mine);
    return mine;
  }

  Crowd columns() const {
    Crowd crowd;
    for (const DistributedCrowd::Agent& agent : agents) {
      crowd.add({agent.shape, agent.x, agent.y, agent.heading, agent.level});
      if (has_heights) crowd.z.push_back(agent.z);
    }
    return crowd;
  }

  Answer answer(Pair pair, float metres) const {
    return {agents[pair.first].id, agents[pair.second].id, metres};
  }

  Answers collisions(const ShapeSet& set, const detail::AllOptions& options = {}) const {
    const Crowd crowd = columns();
    const std::vector<Pair> pairs = candidate_pairs(set, crowd.agents());
    std::vector<std::uint8_t> hits(pairs.size());
    collide(set, crowd.agents(), pairs, hits, options);
    Answers answers;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (hits[i] != 0) answers.push_back(answer(pairs[i], 0));
    return sorted(answers);
  }

  Answers clearances(const ShapeSet& set, const detail::AllOptions& options) const {
    const Crowd crowd = columns();
    const std::vector<Pair> pairs = candidate_pairs(set, crowd.agents(), options.max_distance);
    std::vector<float> metres(pairs.size());
    clearance(set, crowd.agents(), pairs, {.distance = metres}, options);
    Answers answers;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (std::isfinite(metres[i])) answers.push_back(answer(pairs[i], metres[i]));
    return sorted(answers);
  }
};

/// Moves each agent in the world, and on whichever rank owns it, by the same.
template <class Move>
void move_all(World& world, DistributedCrowd& crowd, const Move& move) {
  for (DistributedCrowd::Agent& agent : world.agents) move(agent);
  for (DistributedCrowd::Agent& agent : crowd.agents()) move(agent);
}

}  // namespace bch::test
