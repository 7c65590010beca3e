// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/shape_set/shape_set.hpp"

namespace bch::report {

/// Returns the discs of a cut.
std::vector<Disc> discs_of(const Hierarchy& hierarchy, std::uint32_t depth);

/// Returns what discs and the inside of an outline cover beyond the outline, per cent of the area inside it,
/// of each shape.
/// Runs on all threads.
std::vector<double> excess_areas(std::span<const Shape> shapes, std::uint32_t depth);

}  // namespace bch::report
