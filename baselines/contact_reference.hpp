// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "baselines/cut_lists.hpp"
#include "baselines/leaf_segments.hpp"

namespace bch::baselines {

/// Scalar contacts of a pair: the discs of the first agent's cut that overlap one of the second's, as do all discs above
/// them, and where `segments` decide these meet. Every disc against every disc, in that order; so there are none exactly
/// where the two do not collide.
std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts(const CutLists& cuts, const Agents& agents,
                                                              Pair pair,
                                                              const LeafSegments* segments = nullptr);

}  // namespace bch::baselines
