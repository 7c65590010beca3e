// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/base/build_implementation.hpp"
#include "layout/enclosing_disc/disc_sets.hpp"

namespace bch::detail {

/// Finds the smallest enclosing discs of many sets at once, one set per SIMD lane. Reuses its memory.
class EnclosingDiscs {
 public:
  /// Uses the best implementation that this processor supports.
  EnclosingDiscs() : EnclosingDiscs(best_build_implementation()) {}
  /// Uses a given implementation, which this processor must support.
  explicit EnclosingDiscs(const BuildImplementation& implementation) : loops_(&implementation.loops) {}

  /// Writes the smallest enclosing disc of sets[i] to discs[i], as smallest_enclosing_disc() finds it except for the
  /// rounding of the centre. Sets may overlap; none is empty.
  void solve(std::span<const Vec2> points, std::span<const PointRange> sets, std::span<SolvedDisc> discs);

 private:
  const BuildLoops* loops_;
  std::vector<std::uint32_t> offset_, order_;
  std::vector<double> scratch_;
};

}  // namespace bch::detail
