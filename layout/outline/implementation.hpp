// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "layout/base/instruction_set.hpp"
#include "layout/outline/segment_search.hpp"

namespace bch::detail {

/// Represents one compilation of lanes.hpp, which says what the functions do; all give the same bits.
struct OutlineImplementation : InstructionSet {
  void (*find_sides)(const std::uint32_t* corners, std::size_t count, const GridPoint* points,
                     std::uint8_t* sides) noexcept;
  std::size_t (*find_near)(const SegmentSearch& job, const SearchedWay& way) noexcept;
  void (*test_near)(const SegmentSearch& job, const SearchedWay& way, std::size_t count) noexcept;
};

/// Returns all implementations that were compiled, the best first; the last one runs everywhere.
std::span<const OutlineImplementation> outline_implementations() noexcept;

/// Returns the first implementation that this processor supports.
const OutlineImplementation& best_outline_implementation() noexcept;

}  // namespace bch::detail
