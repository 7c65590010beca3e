// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/halo.hpp"

#include <algorithm>

namespace bch::detail {
namespace {

constexpr std::size_t table_size = 1 << 15;

/// Neighbouring squares have places of their own: 128 columns and 256 rows.
std::size_t place_of(Cell cell) {
  return (static_cast<std::uint32_t>(cell.x) & 127) | (static_cast<std::uint32_t>(cell.y) & 255) << 7;
}

}  // namespace

void CellOwners::reset(const Cut& cut, std::int32_t ring) {
  cut_ = &cut;
  ring_ = ring;
  table_.assign(table_size, {{}, -1, false});
}

const CellOwners::Owner& CellOwners::operator[](Cell cell) {
  Owner& place = table_[place_of(cell)];
  if (place.rank >= 0 && place.cell == cell) return place;
  const int rank = cut_->owner(cell);
  return place = {cell, rank, is_inner(cell, rank)};
}

bool CellOwners::is_inner(Cell cell, int rank) const {
  for (std::int32_t y = -ring_; y <= ring_; ++y)
    for (std::int32_t x = -ring_; x <= ring_; ++x)
      if (cut_->owner({cell.x + x, cell.y + y}) != rank) return false;
  return true;
}

void find_copies(std::span<const DistributedCrowd::Agent> agents, const HaloReach& reach, CellOwners& owners,
                 std::vector<Copy>& copies) {
  for (std::uint32_t i = 0; i < agents.size(); ++i) {
    const DistributedCrowd::Agent& agent = agents[i];
    if (owners[cell_at(agent.x, agent.y, reach.side)].is_inner) continue;
    const double metres = reach.of_shape[agent.shape];
    const Cell low = cell_at(agent.x - metres, agent.y - metres, reach.side);
    const Cell high = cell_at(agent.x + metres, agent.y + metres, reach.side);
    const std::size_t begin = copies.size();
    for (std::int32_t y = low.y; y <= high.y; ++y)
      for (std::int32_t x = low.x; x <= high.x; ++x) {
        const std::int32_t rank = owners[{x, y}].rank;
        const bool is_there = std::any_of(copies.begin() + static_cast<std::ptrdiff_t>(begin), copies.end(),
                                          [&](const Copy& copy) { return copy.rank == rank; });
        if (rank != reach.rank && !is_there) copies.push_back({rank, i});
      }
  }
}

}  // namespace bch::detail
