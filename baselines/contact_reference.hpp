// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "baselines/cut_lists.hpp"

namespace bch::baselines {

/// Scalar contacts of a pair: every disc of the first agent's cut against every disc of the second's, in that order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts(const CutLists& cuts, const Agents& agents,
                                                              Pair pair);

}  // namespace bch::baselines
