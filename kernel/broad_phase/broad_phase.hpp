// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <bch/agents.hpp>

#include "kernel/broad_phase/crowd_grid.hpp"
#include "kernel/broad_phase/pair_test.hpp"
#include "kernel/broad_phase/radix_sort.hpp"
#include "kernel/broad_phase/sorted_discs.hpp"

namespace bch::detail {

/// Errors:  throws std::invalid_argument on a margin outside of 0 .. 2e9 m.
void require_margin(double margin);

/// Finds the pairs that a query has to test. Keeps its memory from call to call.
///
/// Grid:    radii within a factor of four share a grid, so a few large agents do not slow down many small
///          ones. A cell is at least 2^-30 of the crowd's extent.
/// Threads: runs in the caller's TBB arena; one call at a time.
class BroadPhase {
 public:
  /// Returns every pair of agents whose root discs are within `margin` and whose height intervals are within
  /// `height_margin` of each other, once, with first < second. It may contain pairs that exceed the margin by
  /// a few millionths of the margin, the radii and the extents, or by 2^-26 of the largest radius.
  /// Order:   by position, along the rows of a grid; the same for any number of threads.
  /// Memory:  the pairs are valid until the next call; the object keeps 72 bytes per agent and up to 24 per
  ///          pair.
  /// Errors:  throws std::invalid_argument like require_valid_agents(), and on a margin outside 0 .. 2e9;
  ///          std::length_error as soon as there are more pairs than `max_pairs`, before `test` is called.
  std::span<const Pair> find(const ShapeSetView& shapes, const Agents& agents, double margin = 0,
                             std::size_t max_pairs = std::numeric_limits<std::size_t>::max(),
                             const PairTest* test = nullptr, double height_margin = 0);

 private:
  std::span<const Pair> find_valid(const ShapeSetView& shapes, const Agents& agents, double margin,
                                   std::size_t max_pairs, const PairTest* test, double height_margin);
  void sort_discs(const CrowdGrid& grid, const ShapeSetView& shapes, const Agents& agents, double margin);
  void find_in_block(const CrowdGrid& grid, std::size_t begin, std::size_t end, PairList& list,
                     PairCount& count) const;
  void find_in_class(const CrowdGrid& grid, std::uint32_t size_class, std::size_t begin, std::size_t end,
                     PairList& list, PairCount& count) const;
  void find_larger(const CrowdGrid& grid, std::uint32_t size_class, std::size_t begin, std::size_t end,
                   PairList& list, PairCount& count) const;
  void gather_pairs(std::size_t blocks);

  std::vector<GridDisc> placed_;
  RadixSort<GridDisc> radix_sort_;
  SortedDiscs discs_;
  std::array<std::size_t, CrowdGrid::max_classes + 1> class_begin_ = {};  ///< first disc of each class
  std::vector<PairList> found_;                                           ///< by block
  std::vector<std::size_t> found_begin_;  ///< index of a block's first pair among all pairs
  std::vector<Pair> pairs_;
};

}  // namespace bch::detail
