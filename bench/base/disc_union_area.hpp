// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "layout/base/disc.hpp"

namespace bch::cli {

/// The area that discs cover together, square metres; exact up to the rounding of double. By Green's theorem
/// it is an integral over the arcs of each circle that lie in no other disc. Takes n^2 log n for n discs.
double union_area(std::span<const Disc> discs);

}  // namespace bch::cli
