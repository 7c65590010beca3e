// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "bench/workload/race.hpp"

namespace bch::bench {

constexpr std::uint32_t penetration_directions = 16;

/// Returns the queries contacts; penetration, along the best of penetration_directions; collide_all, whose
/// pairs are those of its broad phase. The reference is brute force; collide_all has none, as that of
/// collide() serves for it.
std::span<const TimedQuery> response_queries();

}  // namespace bch::bench
