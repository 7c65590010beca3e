// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/broad_phase.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <bch/query.hpp>

#include "kernel/broad_phase/crowd_grid.hpp"
#include "kernel/broad_phase/radix_sort.hpp"
#include "kernel/broad_phase/sorted_discs.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "kernel/simd/slab_pairs.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t agents_a_task = 2048;
constexpr std::size_t block_discs = 1024;  ///< whose pairs a task finds

CrowdBounds bounds(const ShapeSetView& shapes, const Agents& agents, double margin) {
  return reduce_ranges(
      agents.size(), agents_a_task, CrowdBounds(),
      [&](std::size_t begin, std::size_t end, CrowdBounds all) {
        all.add(detail::bounds(shapes, agents, margin, begin, end));
        return all;
      },
      [](CrowdBounds a, const CrowdBounds& b) {
        a.add(b);
        return a;
      });
}

/// Returns whether parts of two agents are at the same height: those on different floors have none.
bool heights_meet(const ShapeSetView& shapes, const Agents& agents, Pair pair) {
  const auto [a, b] = pair;
  std::uint32_t cursor = 0;
  const SlabPairs<void> slab_pairs(shapes, agents.shape[a], agents.shape[b], agents.z[b] - agents.z[a]);
  return slab_pairs.next(cursor).a != no_part;
}

}  // namespace

/// What find() computes, stage by stage.
struct BroadPhase::State {
  std::vector<GridDisc> placed;
  RadixSort<GridDisc> radix_sort;
  SortedDiscs discs;
  /// Discs of a class.
  std::array<std::size_t, CrowdGrid::most_classes + 1> class_begin;
  std::vector<PairList> found;           ///< by block
  std::vector<std::size_t> found_begin;  ///< among all
  std::vector<Pair> pairs;

  /// Finds the pairs of one agent or more.
  std::span<const Pair> find(const ShapeSetView& shapes, const Agents& agents, double margin,
                             std::size_t most_pairs);
  void sort_discs(const CrowdGrid& grid, const ShapeSetView& shapes, const Agents& agents, double margin);
  void find_in_block(const CrowdGrid& grid, std::size_t begin, std::size_t end, PairList& list,
                     PairCount& count) const;
  void find_in_class(const CrowdGrid& grid, std::uint32_t size_class, std::size_t begin, std::size_t end,
                     PairList& list, PairCount& count) const;
  void find_larger(const CrowdGrid& grid, std::uint32_t size_class, std::size_t begin, std::size_t end,
                   PairList& list, PairCount& count) const;
  void gather_pairs(std::size_t blocks);
};

void BroadPhase::State::sort_discs(const CrowdGrid& grid, const ShapeSetView& shapes, const Agents& agents,
                                   double margin) {
  placed.resize(agents.size());
  for_ranges(agents.size(), agents_a_task, [&](std::size_t begin, std::size_t end) {
    grid.place(shapes, agents, margin, begin, end, placed.data());
  });
  const std::uint32_t classes = grid.class_count();
  radix_sort.sort(placed, static_cast<unsigned>(std::bit_width(grid.end_cell(classes - 1))),
                  [](const GridDisc& disc) { return disc.cell; });
  discs.resize(agents.size());
  for_ranges(agents.size(), agents_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) discs.set(i, placed[i]);
  });
  class_begin[0] = 0;
  for (std::uint32_t c = 0; c < classes; ++c)
    class_begin[c + 1] = discs.first_from(grid.end_cell(c), class_begin[c], discs.size());
}

/// The pairs of discs begin .. end with later ones of their class and with all of coarser classes.
void BroadPhase::State::find_in_block(const CrowdGrid& grid, std::size_t begin, std::size_t end,
                                      PairList& list, PairCount& count) const {
  list.clear();
  for (std::uint32_t c = 0; c < grid.class_count(); ++c) {
    const std::size_t from = std::max(begin, class_begin[c]), to = std::min(end, class_begin[c + 1]);
    if (from >= to) continue;
    find_in_class(grid, c, from, to, list, count);
    find_larger(grid, c, from, to, list, count);
  }
  list.tell(count);
}

/// Half of the neighbourhood, so that each pair is seen once: the rest of a cell and the one beside it are a
/// run of discs, and so are the three cells above. Both runs only move forward.
void BroadPhase::State::find_in_class(const CrowdGrid& grid, std::uint32_t size_class, std::size_t begin,
                                      std::size_t end, PairList& list, PairCount& count) const {
  const std::size_t class_end = class_begin[size_class + 1];
  const std::uint64_t up = grid.stride(size_class);
  const auto skip_below = [&](std::uint64_t cell, std::size_t i) {
    while (i < class_end && discs.cell(i) < cell) ++i;
    return i;
  };
  std::size_t beside_end = begin;
  std::size_t above = discs.first_from(discs.cell(begin) + up - 1, begin, class_end), above_end = above;
  for (std::size_t i = begin; i < end;) {
    const std::uint64_t here = discs.cell(i);
    beside_end = skip_below(here + 2, beside_end);
    above = skip_below(here + up - 1, above);
    above_end = skip_below(here + up + 2, std::max(above, above_end));
    for (; i < end && discs.cell(i) == here; ++i) {
      list.add_overlapping(discs, i, i + 1, beside_end, count);
      list.add_overlapping(discs, i, above, above_end, count);
    }
  }
}

/// Searches all nine cells about a disc, in the grid of every coarser class.
void BroadPhase::State::find_larger(const CrowdGrid& grid, std::uint32_t size_class, std::size_t begin,
                                    std::size_t end, PairList& list, PairCount& count) const {
  for (std::uint32_t c = 0; c < size_class; ++c) {
    if (class_begin[c] == class_begin[c + 1]) continue;
    for (std::size_t i = begin; i < end;) {
      const std::uint64_t here = discs.cell(i);
      const std::size_t cell_end = discs.first_from(here + 1, i, end);
      const std::uint64_t middle = grid.coarser(here, size_class, c), up = grid.stride(c);
      for (const std::uint64_t row : {middle - up, middle, middle + up}) {
        const std::size_t from = discs.first_from(row - 1, class_begin[c], class_begin[c + 1]);
        const std::size_t to = discs.first_from(row + 2, from, class_begin[c + 1]);
        for (std::size_t k = i; from < to && k < cell_end; ++k)
          list.add_overlapping(discs, k, from, to, count);
      }
      i = cell_end;
    }
  }
}

void BroadPhase::State::gather_pairs(std::size_t blocks) {
  found_begin.assign(blocks + 1, 0);
  for (std::size_t b = 0; b < blocks; ++b) found_begin[b + 1] = found_begin[b] + found[b].pairs().size();
  pairs.resize(found_begin[blocks]);
  for_ranges(blocks, 1, [&](std::size_t first, std::size_t last) {
    auto to = pairs.begin() + static_cast<std::ptrdiff_t>(found_begin[first]);
    for (std::size_t b = first; b < last; ++b)
      to = std::transform(found[b].pairs().begin(), found[b].pairs().end(), to, [](Pair pair) {
        return Pair{std::min(pair.first, pair.second), std::max(pair.first, pair.second)};
      });
  });
}

std::span<const Pair> BroadPhase::State::find(const ShapeSetView& shapes, const Agents& agents, double margin,
                                              std::size_t most_pairs) {
  const CrowdGrid grid(bounds(shapes, agents, margin));
  sort_discs(grid, shapes, agents, margin);
  const std::size_t blocks = (agents.size() + block_discs - 1) / block_discs;
  if (found.size() < blocks) found.resize(blocks);
  PairCount count(most_pairs);
  for_ranges(blocks, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t begin = b * block_discs, end = std::min(begin + block_discs, agents.size());
      find_in_block(grid, begin, end, found[b], count);
      if (!agents.z.empty()) found[b].keep_if([&](Pair pair) { return heights_meet(shapes, agents, pair); });
    }
  });
  gather_pairs(blocks);
  return pairs;
}

BroadPhase::BroadPhase() : state_(std::make_unique<State>()) {}
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;
BroadPhase::~BroadPhase() = default;

std::span<const Pair> BroadPhase::find(const ShapeSet& shapes, const Agents& agents, double margin,
                                       std::size_t most_pairs) {
  const FloatingPointStateGuard floats;
  validate(shapes, agents);
  if (!(margin >= 0 && margin <= 2 * rounding::largest_position))
    throw std::invalid_argument("broad phase: a margin of " + shortest(margin) + " m");
  if (agents.size() == 0) return {};
  return without_tasks_from_outside([&] { return state_->find(shapes.view(), agents, margin, most_pairs); });
}

std::vector<Pair> candidate_pairs(const ShapeSet& shapes, const Agents& agents, double margin,
                                  std::size_t most_pairs) {
  BroadPhase broad_phase;
  const std::span<const Pair> pairs = broad_phase.find(shapes, agents, margin, most_pairs);
  return {pairs.begin(), pairs.end()};
}

}  // namespace bch
