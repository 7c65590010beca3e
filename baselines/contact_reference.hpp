// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "baselines/cut_lists.hpp"
#include "baselines/leaf_segments.hpp"

namespace bch::baselines {

/// Returns the contacts of a pair by testing every disc against every disc, in that order. A contact is a disc of the
/// first agent's cut and one of the second's that overlap, as do all discs above them; where `segments` decide, these
/// meet, too. So there are none exactly where the two do not collide.
std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts(const CutLists& cuts, const Agents& agents,
                                                              Pair pair,
                                                              const LeafSegments* segments = nullptr);

}  // namespace bch::baselines
