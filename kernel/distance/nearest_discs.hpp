// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/clearance.hpp>

#include "kernel/distance/clearance_arguments.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// The nearest discs of two agents, the one with the lower index first. What is computed of them is so in double, where
/// squares do not underflow.
struct FoundDiscs {
  const ShapeSetView& shapes;
  const Agents& agents;
  Pair pair;  ///< the lower index first
  const NearestDiscs& nearest;
};

/// Returns the numbers of the discs in the cuts.
DiscPair numbers(const FoundDiscs& found);

/// Returns the unit vector from one disc to the other, or with a sign of -1 that from the second to the first; (sign, 0)
/// where their centres coincide.
Vec2 direction(const NearestDiscs& nearest, double sign);

/// Returns the discs' points that are nearest to each other.
NearestPoints points(const FoundDiscs& found);

}  // namespace bch::detail
