// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/broad_phase/broad_phase.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "kernel/runtime/pair_heights.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t agents_per_task = 2048;
constexpr std::size_t block_discs = 1024;  ///< discs whose pairs one task finds

CrowdBounds bounds(const ShapeSetView& shapes, const Agents& agents, double margin) {
  return reduce_ranges(
      agents.size(), agents_per_task, CrowdBounds(),
      [&](std::size_t begin, std::size_t end, CrowdBounds all) {
        all.add(detail::bounds(shapes, agents, margin, begin, end));
        return all;
      },
      [](CrowdBounds a, const CrowdBounds& b) {
        a.add(b);
        return a;
      });
}

}  // namespace

void BroadPhase::sort_discs(const CrowdGrid& grid, const ShapeSetView& shapes, const Agents& agents,
                            double margin) {
  placed_.resize(agents.size());
  for_ranges(agents.size(), agents_per_task, [&](std::size_t begin, std::size_t end) {
    grid.place(shapes, agents, margin, begin, end, placed_.data());
  });
  const std::uint32_t classes = grid.class_count();
  radix_sort_.sort(placed_, static_cast<unsigned>(std::bit_width(grid.end_cell(classes - 1))),
                   [](const GridDisc& disc) { return disc.cell; });
  discs_.resize(agents.size());
  for_ranges(agents.size(), agents_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) discs_.set(i, placed_[i]);
  });
  class_begin_[0] = 0;
  for (std::uint32_t c = 0; c < classes; ++c)
    class_begin_[c + 1] = discs_.first_from(grid.end_cell(c), class_begin_[c], discs_.size());
}

/// Finds the pairs of discs begin .. end with later discs of their class, and with all discs of coarser
/// classes.
void BroadPhase::find_in_block(const CrowdGrid& grid, std::size_t begin, std::size_t end, PairList& list,
                               PairCount& count) const {
  list.clear();
  for (std::uint32_t c = 0; c < grid.class_count(); ++c) {
    const std::size_t from = std::max(begin, class_begin_[c]), to = std::min(end, class_begin_[c + 1]);
    if (from >= to) continue;
    find_in_class(grid, c, from, to, list, count);
    find_larger(grid, c, from, to, list, count);
  }
  list.report(count);
}

/// Searches half of the neighbourhood, so that each pair is found once: the rest of a cell and the next cell,
/// which are contiguous discs, and the three cells above, which are contiguous, too. Both ranges only move
/// forward.
void BroadPhase::find_in_class(const CrowdGrid& grid, std::uint32_t size_class, std::size_t begin,
                               std::size_t end, PairList& list, PairCount& count) const {
  const std::size_t class_end = class_begin_[size_class + 1];
  const std::uint64_t up = grid.stride(size_class);
  const auto skip_below = [&](std::uint64_t cell, std::size_t i) {
    while (i < class_end && discs_.cell(i) < cell) ++i;
    return i;
  };
  std::size_t row_end = begin;
  std::size_t above = discs_.first_from(discs_.cell(begin) + up - 1, begin, class_end), above_end = above;
  for (std::size_t i = begin; i < end;) {
    const std::uint64_t here = discs_.cell(i);
    row_end = skip_below(here + 2, row_end);
    above = skip_below(here + up - 1, above);
    above_end = skip_below(here + up + 2, std::max(above, above_end));
    for (; i < end && discs_.cell(i) == here; ++i) {
      list.add_overlapping(discs_, i, i + 1, row_end, count);
      list.add_overlapping(discs_, i, above, above_end, count);
    }
  }
}

/// Searches all nine cells around a disc in the grid of every coarser class.
void BroadPhase::find_larger(const CrowdGrid& grid, std::uint32_t size_class, std::size_t begin,
                             std::size_t end, PairList& list, PairCount& count) const {
  for (std::uint32_t c = 0; c < size_class; ++c) {
    if (class_begin_[c] == class_begin_[c + 1]) continue;
    for (std::size_t i = begin; i < end;) {
      const std::uint64_t here = discs_.cell(i);
      const std::size_t cell_end = discs_.first_from(here + 1, i, end);
      const std::uint64_t middle = grid.coarser(here, size_class, c), up = grid.stride(c);
      for (const std::uint64_t row : {middle - up, middle, middle + up}) {
        const std::size_t from = discs_.first_from(row - 1, class_begin_[c], class_begin_[c + 1]);
        const std::size_t to = discs_.first_from(row + 2, from, class_begin_[c + 1]);
        for (std::size_t k = i; from < to && k < cell_end; ++k)
          list.add_overlapping(discs_, k, from, to, count);
      }
      i = cell_end;
    }
  }
}

void BroadPhase::gather_pairs(std::size_t blocks) {
  found_begin_.assign(blocks + 1, 0);
  for (std::size_t b = 0; b < blocks; ++b) found_begin_[b + 1] = found_begin_[b] + found_[b].pairs().size();
  pairs_.resize(found_begin_[blocks]);
  for_ranges(blocks, 1, [&](std::size_t first, std::size_t last) {
    auto to = pairs_.begin() + static_cast<std::ptrdiff_t>(found_begin_[first]);
    for (std::size_t b = first; b < last; ++b)
      to = std::transform(found_[b].pairs().begin(), found_[b].pairs().end(), to, [](Pair pair) {
        return Pair{std::min(pair.first, pair.second), std::max(pair.first, pair.second)};
      });
  });
}

std::span<const Pair> BroadPhase::find_valid(const ShapeSetView& shapes, const Agents& agents, double margin,
                                             std::size_t max_pairs, const PairTest* test,
                                             double height_margin) {
  const CrowdGrid grid(bounds(shapes, agents, margin));
  sort_discs(grid, shapes, agents, margin);
  const std::size_t blocks = (agents.size() + block_discs - 1) / block_discs;
  if (found_.size() < blocks) found_.resize(blocks);
  PairCount count(max_pairs);
  const Arguments in = arguments_for(shapes, agents, {});
  for_ranges(blocks, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t begin = b * block_discs, end = std::min(begin + block_discs, agents.size());
      find_in_block(grid, begin, end, found_[b], count);
      if (test != nullptr) found_[b].keep_if([&](Pair pair) { return test->accepts(pair); });
      if (!agents.z.empty())
        found_[b].keep_if([&](Pair pair) { return heights_meet(in, pair, height_margin); });
    }
  });
  gather_pairs(blocks);
  return pairs_;
}

void require_margin(double margin) {
  if (margin >= 0 && margin <= 2 * rounding::largest_position) return;
  throw std::invalid_argument("candidates: expected a margin from 0 to 2e9 m, found " + shortest(margin));
}

std::span<const Pair> BroadPhase::find(const ShapeSetView& shapes, const Agents& agents, double margin,
                                       std::size_t max_pairs, const PairTest* test, double height_margin) {
  const FloatingPointStateGuard floats;
  require_valid_agents(shapes, agents);
  require_margin(margin);
  if (agents.size() == 0) return {};
  return without_tasks_from_outside(
      [&] { return find_valid(shapes, agents, margin, max_pairs, test, height_margin); });
}

}  // namespace bch::detail
