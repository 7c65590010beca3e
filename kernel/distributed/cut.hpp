// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kernel/distributed/curve.hpp"

namespace bch::detail {

/// Holds what a place on the curve weighs: pairs, mostly.
struct Weight {
  std::uint64_t key, weight;
};

/// Represents a division of the curve among ranks: each rank owns the squares from its first key to the next rank's.
class Cut {
 public:
  /// Takes the first keys of all ranks but rank 0, ascending.
  explicit Cut(std::vector<std::uint64_t> firsts = {}) : firsts_(std::move(firsts)) {}

  int owner(std::uint64_t key) const {
    return static_cast<int>(std::ranges::upper_bound(firsts_, key) - firsts_.begin());
  }
  int owner(Cell cell) const { return owner(curve_key(cell)); }
  std::span<const std::uint64_t> firsts() const { return firsts_; }

 private:
  std::vector<std::uint64_t> firsts_;
};

/// Writes, for each of some keys, the weight of all places before it.
using WeightBefore =
    std::function<void(std::span<const std::uint64_t> keys, std::span<std::uint64_t> before)>;

/// Returns that of weights in order of their keys; they become sums.
WeightBefore weight_before(std::vector<Weight>& sorted);

/// Cuts the curve for so many ranks into parts that weigh the same, up to one square's weight: by bisection of all cuts at once,
/// which asks for nothing but sums, so that it does not matter where the weights are.
Cut cut_evenly(int ranks, const WeightBefore& weight_before);

/// Cuts weights that lie on many ranks in any order; the same cut on each.
/// Returns in `imbalance` the heaviest part over the mean.
Cut cut_evenly(MPI_Comm comm, std::vector<Weight> weights, double& imbalance);

}  // namespace bch::detail
