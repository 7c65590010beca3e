// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layout/base/instruction_set.hpp"
#include "layout/enclosing_disc/disc_sets.hpp"

namespace bch::detail {

/// Represents one compilation of the solver; all give the same bits.
struct DiscImplementation : InstructionSet {
  void (*solve)(const DiscSets& sets) noexcept;
};

/// Returns all implementations that were compiled, the best first; the last one runs everywhere.
std::span<const DiscImplementation> disc_implementations() noexcept;

/// Finds the smallest enclosing discs of many sets at once, solved side by side. Keeps its memory.
class EnclosingDiscs {
 public:
  /// Uses the best implementation that this processor supports.
  EnclosingDiscs();
  /// Uses a given implementation, which this processor has to support.
  explicit EnclosingDiscs(const DiscImplementation& implementation);

  /// Sets may overlap; none is empty. discs[i] is as smallest_enclosing_disc() would have it but for the
  /// rounding of the centre.
  void solve(std::span<const Vec2> points, std::span<const PointRange> sets, std::span<SolvedDisc> discs);

 private:
  const DiscImplementation* implementation_;
  std::vector<std::uint32_t> offset_, order_;
  std::vector<double> scratch_;
};

}  // namespace bch::detail
