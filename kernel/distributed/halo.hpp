// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/distributed_crowd.hpp>

#include "kernel/distributed/curve.hpp"
#include "kernel/distributed/cut.hpp"

namespace bch::detail {

/// Tells who owns a square, and whether all squares about it belong to the same rank: an agent there is nobody else's concern. Keeps the
/// answers, because a key costs as much as a pair of agents, and many stand in a square.
class CellOwners {
 public:
  /// Forgets everything: the crowd was cut, or `ring`, how many squares about one count, is another.
  void reset(const Cut& cut, std::int32_t ring);
  struct Owner {
    Cell cell;
    std::int32_t rank;
    bool is_inner;
  };
  const Owner& operator[](Cell cell);

 private:
  bool is_inner(Cell cell, int rank) const;

  const Cut* cut_ = nullptr;
  std::int32_t ring_ = 0;
  std::vector<Owner> table_;  ///< each square has one place, which it shares with others
};

/// Represents an agent that another rank needs a copy of.
struct Copy {
  std::int32_t rank;
  std::uint32_t agent;
};

/// Says how far copies are needed, and of which squares.
struct HaloReach {
  std::span<const double>
      of_shape;  ///< metres that an agent and any other may reach together, by the agent's shape
  double side;   ///< of a square
  int rank;      ///< whose agents they are
};

/// Appends, for each agent, the ranks that own squares within its reach.
void find_copies(std::span<const DistributedCrowd::Agent> agents, const HaloReach& reach, CellOwners& owners,
                 std::vector<Copy>& copies);

}  // namespace bch::detail
