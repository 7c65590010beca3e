// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include <bch/crowd.hpp>

namespace bch::detail {

/// Implements Crowd::Clearances::disc_radii(). `period`: positions are compared modulo it. `alone`: the radius of an
/// agent without a pair, metres.
std::vector<double> disc_radii(std::span<const Pair> pairs, std::span<const float> clearance,
                               const Agents& agents, CrowdOptions::Period period, double alone);

}  // namespace bch::detail
