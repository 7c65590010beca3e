// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/cut.hpp"

#include <limits>

namespace bch::detail {
namespace {

constexpr std::uint64_t last_key = std::numeric_limits<std::uint64_t>::max();

/// What each part is meant to weigh together with those before it.
std::vector<std::uint64_t> even_sums(int ranks, std::uint64_t total) {
  std::vector<std::uint64_t> sums;
  const auto parts = static_cast<std::uint64_t>(ranks);
  for (std::uint64_t part = 1; part < parts; ++part)
    sums.push_back(total / parts * part + total % parts * part / parts);
  return sums;
}

/// The heaviest part over the mean; 1 where nothing weighs anything.
double imbalance_of(const Cut& cut, const WeightBefore& weight_before) {
  std::vector<std::uint64_t> ends(cut.firsts().begin(), cut.firsts().end());
  ends.push_back(last_key);
  std::vector<std::uint64_t> sums(ends.size());
  weight_before(ends, sums);
  std::uint64_t most = 0, before = 0;
  for (const std::uint64_t sum : sums) most = std::max(most, sum - before), before = sum;
  if (before == 0) return 1;
  return static_cast<double>(most) * static_cast<double>(sums.size()) / static_cast<double>(before);
}

}  // namespace

WeightBefore weight_before(std::vector<Weight>& sorted) {
  std::uint64_t sum = 0;
  for (Weight& one : sorted) sum += one.weight, one.weight = sum;
  return [&sorted](std::span<const std::uint64_t> keys, std::span<std::uint64_t> before) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const auto first = std::ranges::lower_bound(sorted, keys[i], {}, &Weight::key);
      before[i] = first == sorted.begin() ? 0 : std::prev(first)->weight;
    }
  };
}

Cut cut_evenly(int ranks, const WeightBefore& weight_before) {
  std::uint64_t total;
  weight_before(std::span(&last_key, 1), std::span(&total, 1));
  const std::vector<std::uint64_t> wanted = even_sums(ranks, total);
  // Each cut lies in (low, high]: before high there is at least what is wanted, or it is the end.
  std::vector<std::uint64_t> low(wanted.size(), 0), high(wanted.size(), last_key), middle(low), sums(low);
  for (int bit = 0; bit < 64; ++bit) {
    for (std::size_t i = 0; i < wanted.size(); ++i) middle[i] = low[i] + (high[i] - low[i]) / 2;
    weight_before(middle, sums);
    for (std::size_t i = 0; i < wanted.size(); ++i) (sums[i] < wanted[i] ? low : high)[i] = middle[i];
  }
  return Cut(std::move(high));
}

Cut cut_evenly(MPI_Comm comm, std::vector<Weight> weights, double& imbalance) {
  std::ranges::sort(weights, {}, &Weight::key);
  const WeightBefore here = weight_before(weights);
  const WeightBefore everywhere = [&](std::span<const std::uint64_t> keys, std::span<std::uint64_t> before) {
    here(keys, before);
    MPI_Allreduce(MPI_IN_PLACE, before.data(), static_cast<int>(before.size()), MPI_UINT64_T, MPI_SUM, comm);
  };
  int ranks;
  MPI_Comm_size(comm, &ranks);
  Cut cut = cut_evenly(ranks, everywhere);
  imbalance = imbalance_of(cut, everywhere);
  return cut;
}

}  // namespace bch::detail
