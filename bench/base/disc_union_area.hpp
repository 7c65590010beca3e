// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>
#include <bch/hierarchy.hpp>

namespace bch::cli {

/// Returns the area that discs cover together, square metres; exact up to the rounding of double. By Green's
/// theorem it is an integral over the arcs of each circle that lie in no other disc. Takes O(n^2 log n) time
/// for n discs.
double union_area(std::span<const Disc> discs);

/// Returns the discs of a cut.
std::vector<Disc> discs_of(const Hierarchy& hierarchy, std::uint32_t depth);

}  // namespace bch::cli
