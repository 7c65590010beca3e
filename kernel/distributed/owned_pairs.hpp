// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/distributed_crowd.hpp>

namespace bch::detail {

/// Holds the agents of a rank and the copies of others', as queries take them: in the order of their ids, as one process has them,
/// because of two agents the first one's place in memory decides whose frame a pair is examined in.
struct CrowdColumns {
  std::vector<std::uint32_t> id, shape;
  std::vector<double> x, y, z, heading;
  std::vector<std::uint8_t> level, is_own;

  /// Takes a rank's agents and the copies of others, both in the order of their ids.
  void assign(std::span<const DistributedCrowd::Agent> own, std::span<const DistributedCrowd::Agent> copies,
              bool heights);
  /// Gives each agent a shape of its own: first those of the rank's agents, then those of the copies, in the order of their ids.
  void number_shapes(std::size_t own);
  Agents agents() const { return {shape, x, y, heading, level, z}; }

 private:
  void resize(std::size_t size, bool heights);
  void set(std::size_t i, const DistributedCrowd::Agent& agent, bool own);
};

/// Finds the pairs that a rank answers among candidates: those whose first agent, which has the lower id, is its own.
void keep_owned(const CrowdColumns& columns, std::span<const Pair> candidates, std::vector<Pair>& owned);

/// Writes the ids of pairs that are hit.
void keep_hits(const CrowdColumns& columns, std::span<const Pair> pairs, std::span<const std::uint8_t> hits,
               std::vector<Pair>& ids);

/// Writes the ids and distances of pairs with a finite one.
void keep_near(const CrowdColumns& columns, std::span<const Pair> pairs, std::span<const float> distances,
               std::vector<DistributedCrowd::Distance>& near);

}  // namespace bch::detail
