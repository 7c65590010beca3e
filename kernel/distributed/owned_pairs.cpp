// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/owned_pairs.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "kernel/distributed/resize.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t grain = 1 << 15;  ///< agents or pairs a task

/// Keeps those of `count` items, in their order, for which keep(i) is true: write(i) is what is kept of one.
template <class Kept, class Keep, class Write>
void compact(std::size_t count, std::vector<Kept>& kept, const Keep& keep, const Write& write) {
  std::vector<std::size_t> begins((count + grain - 1) / grain + 1, 0);
  const auto block = [&](std::size_t b) { return std::pair(b * grain, std::min(count, (b + 1) * grain)); };
  for_ranges(begins.size() - 1, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b)
      for (auto [i, end] = block(b); i < end; ++i) begins[b + 1] += keep(i) ? 1 : 0;
  });
  for (std::size_t b = 1; b < begins.size(); ++b) begins[b] += begins[b - 1];
  resize_with_spare(kept, begins.back());
  for_ranges(begins.size() - 1, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first, place = begins[b]; b < last; ++b)
      for (auto [i, end] = block(b); i < end; ++i)
        if (keep(i)) kept[place++] = write(i);
  });
}

}  // namespace

void CrowdColumns::resize(std::size_t size, bool heights) {
  for (auto* const column : {&id, &shape}) resize_with_spare(*column, size);
  for (auto* const column : {&x, &y, &heading}) resize_with_spare(*column, size);
  for (auto* const column : {&level, &is_own}) resize_with_spare(*column, size);
  resize_with_spare(z, heights ? size : 0);
}

void CrowdColumns::set(std::size_t i, const DistributedCrowd::Agent& agent, bool own) {
  id[i] = agent.id, shape[i] = agent.shape, level[i] = agent.level, is_own[i] = own;
  x[i] = agent.x, y[i] = agent.y, heading[i] = agent.heading;
  if (!z.empty()) z[i] = agent.z;
}

void CrowdColumns::assign(std::span<const DistributedCrowd::Agent> own,
                          std::span<const DistributedCrowd::Agent> copies, bool heights) {
  resize(own.size() + copies.size(), heights);
  const auto copies_before = [&](std::size_t i) {  // those that go before one of our own
    if (i == 0) return std::size_t{0};
    if (i == own.size()) return copies.size();
    return static_cast<std::size_t>(
        std::ranges::lower_bound(copies, own[i].id, {}, &DistributedCrowd::Agent::id) - copies.begin());
  };
  if (own.empty()) {
    for (std::size_t i = 0; i < copies.size(); ++i) set(i, copies[i], false);
    return;
  }
  for_ranges(own.size(), grain, [&](std::size_t first, std::size_t last) {
    std::size_t copy = copies_before(first);
    const std::size_t end = copies_before(last);
    for (std::size_t i = first; i < last; ++i) {
      for (; copy < end && copies[copy].id < own[i].id; ++copy) set(i + copy, copies[copy], false);
      set(i + copy, own[i], true);
    }
    for (; copy < end; ++copy) set(last + copy, copies[copy], false);
  });
}

void CrowdColumns::number_shapes(std::size_t own) {
  std::uint32_t next_own = 0, next_copy = static_cast<std::uint32_t>(own);
  for (std::size_t i = 0; i < shape.size(); ++i) shape[i] = is_own[i] != 0 ? next_own++ : next_copy++;
}

void keep_owned(const CrowdColumns& columns, std::span<const Pair> candidates, std::vector<Pair>& owned) {
  compact(
      candidates.size(), owned, [&](std::size_t i) { return columns.is_own[candidates[i].first] != 0; },
      [&](std::size_t i) { return candidates[i]; });
}

void keep_hits(const CrowdColumns& columns, std::span<const Pair> pairs, std::span<const std::uint8_t> hits,
               std::vector<Pair>& ids) {
  compact(
      pairs.size(), ids, [&](std::size_t i) { return hits[i] != 0; },
      [&](std::size_t i) {
        return Pair{columns.id[pairs[i].first], columns.id[pairs[i].second]};
      });
}

void keep_near(const CrowdColumns& columns, std::span<const Pair> pairs, std::span<const float> distances,
               std::vector<DistributedCrowd::Distance>& near) {
  compact(
      pairs.size(), near,
      [&](std::size_t i) { return distances[i] < std::numeric_limits<float>::infinity(); },
      [&](std::size_t i) {
        return DistributedCrowd::Distance{columns.id[pairs[i].first], columns.id[pairs[i].second],
                                          distances[i]};
      });
}

}  // namespace bch::detail
